// SPDX-License-Identifier: Apache-2.0
// The simulated body: 33 joints, as BlazePose has them.
#pragma once

#include <array>

#include "core/common/target.hpp"

namespace foretrack {

/// Where a person really is and how they move. World ENU.
struct PersonState {
  double stamp_s = 0.0;
  Vec3 position_enu_m = Vec3::Zero();  ///< the torso's centre
  Vec3 velocity_enu_m_s = Vec3::Zero();
  Vec3 acceleration_enu_m_s2 = Vec3::Zero();
  double body_yaw_rad = 0.0;   ///< where the chest points, ENU
  double head_turn_rad = 0.0;  ///< of the head from there, to the left
  double stride_rad = 0.0;     ///< phase of the legs; 2π is two steps
};

/// The 33 joints in the world, left and right as the person's own. Legs and arms swing with the
/// stride, the more the faster the person walks. The mean of joints 11, 12, 23 and 24 is
/// position_enu_m. Proportions: Drillis and Contini 1966. Cost: 1 µs.
std::array<Vec3, kLandmarkCount> joints_enu_m(const PersonState& state, double height_m);

/// Height of the shoulders as a share of the person's.
inline constexpr double kShoulderShare = 0.818;

/// Height of the torso's centre above the feet of a person of this height.
double torso_height_m(double height_m);

/// The points that decide whether the person is in sight: head, left and right shoulder, middle of
/// the hips, middle of the knees. World ENU.
std::array<Vec3, 5> body_points_enu_m(const PersonState& state, double height_m);

}  // namespace foretrack
