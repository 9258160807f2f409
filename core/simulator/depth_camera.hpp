// SPDX-License-Identifier: Apache-2.0
// A depth camera that sees the world, the ground and the person.
#pragma once

#include <cstdint>
#include <vector>

#include "core/common/camera.hpp"
#include "core/common/random.hpp"
#include "core/common/vehicle.hpp"
#include "core/simulator/person.hpp"
#include "core/simulator/world.hpp"

namespace foretrack {

struct DepthCameraParams {
  CameraModel camera = CameraModel::from_fov(160, 120, rad(90.0), rad(75.0));
  double rate_hz = 15.0;
  double range_max_m = 8.0;
  double noise_m = 0.02;  // standard deviation up to 4 m; beyond, it grows with the square
  double dropout = 0.0;   // share of pixels without a return
};

struct DepthCamera {
  DepthCameraParams params;
  Random random{1};
  double next_image_s = 0.0;
  DepthImage image;
  std::vector<Vec3> rays;  // of the pixels in the optical frame, z = 1
};
DepthCamera make_depth_camera(const DepthCameraParams& params, std::uint64_t seed);

/// Exact depths in the image → what the camera measures: noise, dropouts, twice the range beyond
/// it. 0 stays 0.
void add_noise(DepthCamera& camera);

/// Renders exact depths with noise (each shape's rays only within its image): where nothing is in
/// range, twice the range (free to there). The person is an upright cylinder. Cost: about 1–3 ms
/// for 160 × 120 pixels and 120 shapes.
void render(DepthCamera& camera, const World& world, const VehicleState& vehicle,
            const PersonState& person, double height_m);

/// The new image if one is due now, else null. Valid until the next call.
const DepthImage* image_depth(DepthCamera& camera, const World& world, const VehicleState& vehicle,
                              const PersonState& person, double height_m);

}  // namespace foretrack
