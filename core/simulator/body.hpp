// SPDX-License-Identifier: Apache-2.0
// A body with the 33 joints of BlazePose.
#pragma once

#include <array>

#include "core/common/target.hpp"

namespace foretrack {

/// Truth. The position is that of the torso's centre.
struct PersonState {
  double stamp_s = 0.0;
  Vec3 position_enu_m = Vec3::Zero();
  Vec3 velocity_enu_m_s = Vec3::Zero();
  Vec3 acceleration_enu_m_s2 = Vec3::Zero();
  double body_yaw_rad = 0.0;
  double stride_rad = 0.0;  // phase of the legs
};

/// The 33 joints in the world, left and right as the person's own; legs and arms swing with the
/// stride. The mean of joints 11, 12, 23 and 24 is position_enu_m.
std::array<Vec3, kLandmarkCount> joints_enu_m(const PersonState& state, double height_m);

/// Height of the shoulders over that of the person.
inline constexpr double kShoulderShare = 0.818;

/// Height of the torso's centre above the feet.
double torso_height_m(double height_m);

/// Points that decide whether the person is in sight: head, both shoulders, hip, knee.
std::array<Vec3, 5> body_points_enu_m(const PersonState& state, double height_m);

}  // namespace foretrack
