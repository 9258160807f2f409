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

/// A depth camera and its noise.
struct DepthCameraParams {
  CameraModel camera = CameraModel::from_fov(160, 120, rad(90.0), rad(75.0));
  double rate_hz = 15.0;
  double range_max_m = 8.0;
  double noise_m = 0.02;  ///< standard deviation up to 4 m; beyond, it grows with the square
  double dropout = 0.0;   ///< share of pixels without a return
};

/// A camera with its last image.
struct DepthCamera {
  DepthCameraParams params;
  Random random{1};
  double next_image_s = 0.0;  ///< when one is due
  DepthImage image;
  std::vector<Vec3> rays;  ///< through the middles of the pixels; optical frame, z = 1
};
/// A camera whose noise follows the seed.
DepthCamera make_depth_camera(const DepthCameraParams& params, std::uint64_t seed);

/// Turns exact depths in the image into what the camera measures. Noise is added, some returns are
/// dropped (0), and depths beyond the range become twice the range. 0 stays 0.
void add_noise(DepthCamera& camera);

/// Renders the depths of the world, the ground and the person (an upright cylinder of 0.25 m
/// radius) from the vehicle at its stamp, exact rays with noise added. Cost: about 1–3 ms for 160 ×
/// 120 pixels and 120 shapes.
void render(DepthCamera& camera, const World& world, const VehicleState& vehicle,
            const PersonState& person, double height_m);

/// The new image if one is due now, else null. Valid until the next call.
const DepthImage* image_depth(DepthCamera& camera, const World& world, const VehicleState& vehicle,
                              const PersonState& person, double height_m);

}  // namespace foretrack
