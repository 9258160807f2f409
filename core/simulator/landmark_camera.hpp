// SPDX-License-Identifier: Apache-2.0
// A camera and a pose network in one: images of the person as noisy landmarks.
#pragma once

#include <optional>
#include <vector>

#include "core/common/random.hpp"
#include "core/common/vehicle.hpp"
#include "core/simulator/person.hpp"
#include "core/simulator/world.hpp"

namespace foretrack {

/// How well landmarks are seen. Noise is a standard deviation on each axis.
struct LandmarkCameraParams {
  CameraModel camera;
  double rate_hz = 30.0;
  double noise_px = 2.0;            ///< of each image point
  double joint_noise_m = 0.03;      ///< of each joint's place in the body
  double correlated_share = 0.5;    ///< of the noise's variance that lasts from image to image
  double correlation_s = 0.3;       ///< time constant in which that part is forgotten
  double dropout = 0.0;             ///< share of images without a detection
  double flip_share = 0.0;          ///< share of time in which left is taken for right, in spells
  double delay_s = 0.05;            ///< from the image to its delivery
  double range_max_m = 8.0;         ///< nobody is seen farther away
  double landmark_height_m = 1.75;  ///< joints are given for a person of this height
  int landmarks_needed = 10;        ///< with fewer in view nobody is detected
  bool fov_gated = true;            ///< false: the border of the image does not matter
};

/// A camera with what it keeps from image to image.
struct LandmarkCamera {
  /// Of one landmark, in standard deviations.
  struct Noise {
    Vec2 image_px = Vec2::Zero();
    Vec3 joint_m = Vec3::Zero();
  };
  LandmarkCameraParams params;
  Random random{1};
  double next_image_s = 0.0;                    ///< when one is due
  double last_image_s = -1e9;                   ///< when landmarks were seen last
  bool flipped = false;                         ///< left and right are taken for each other
  double flips_until_s = -1e9;                  ///< when that is drawn anew
  std::array<Noise, kLandmarkCount> lasting{};  ///< the part of the noise that lasts
  std::vector<TargetObservation> waiting;       ///< for their delivery; the oldest first
};
/// A camera that has been looking for a while: its lasting noise is in full swing.
LandmarkCamera make_landmark_camera(const LandmarkCameraParams& params, std::uint64_t seed);

/// Takes an image if one is due, and returns an observation if the delay of one is over. Its stamp
/// is the image's. A landmark that the world hides, or that is outside the image, has low
/// visibility and a poor place. Without the border (fov_gated false), a person beside or behind the
/// camera is observed as a position. None: nothing is delivered now. Cost: about 20 µs for an
/// image.
std::optional<TargetObservation> observe(LandmarkCamera& camera, const World& world,
                                         const VehicleState& vehicle, const PersonState& person,
                                         double height_m);

/// What of the person the camera can really see.
struct Sight {
  bool in_view = false;   ///< the torso's centre is within the angles of view and the range
  bool unhidden = false;  ///< nothing is between the camera and at least half of the body points
  /// Both.
  bool visible() const { return in_view && unhidden; }
};
/// The truth for scores, without noise: see body_points_enu_m().
Sight sight_of(const World& world, const CameraModel& camera, const VehicleState& vehicle,
               const PersonState& person, double height_m, double range_max_m);

}  // namespace foretrack
