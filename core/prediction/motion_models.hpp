// SPDX-License-Identifier: Apache-2.0
// How a person moves while one intention lasts (paper Tab. I).
#pragma once

#include "core/common/geometry.hpp"

namespace foretrack {

/// Where somebody is on the ground plane, and how they move.
struct PlanarState {
  Vec2 position_m = Vec2::Zero();    // world ENU
  Vec2 velocity_m_s = Vec2::Zero();  // world ENU
};

/// How the target has gone so far, and which way they would go back.
struct Gait {
  double pace_m_s = 0.0;  // greatest speed of the last second
  double back_rad = 0.0;  // against their course; where the chest points, once it has turned round
};

/// How somebody moves while one intention lasts.
struct MotionModel {
  enum class Kind { kConstantVelocity, kCoordinatedTurn, kDeceleration, kReversal };
  Kind kind = Kind::kConstantVelocity;
  double rate = 0.0;             // rad/s, > 0: to the left; or m/s² > 0 of the change of velocity
  Vec2 goal_m_s = Vec2::Zero();  // the velocity at which a deceleration, or a reversal, ends

  static MotionModel constant_velocity() { return {}; }
  static MotionModel turn(double rate_rad_s) { return {Kind::kCoordinatedTurn, rate_rad_s}; }
  /// Ends at rest, never backwards.
  static MotionModel deceleration(double rate_m_s2) { return {Kind::kDeceleration, rate_m_s2}; }
  /// Slows down, turns round, and goes on at the goal: the velocity changes straight towards it, at
  /// this rate, and is then kept. No faster than at the start or at the goal.
  static MotionModel reversal(double rate_m_s2, const Vec2& goal_m_s) {
    return {Kind::kReversal, rate_m_s2, goal_m_s};
  }
};

/// The state after dt_s ≥ 0; exact for any duration and for ω → 0. Cost: one sincos for a turn.
PlanarState advance(const MotionModel& model, const PlanarState& state, double dt_s);

/// Derivatives of advance() by the velocity (that by the position is the identity).
struct MotionJacobian {
  Mat2 position_by_velocity;
  Mat2 velocity_by_velocity;
};
/// Of advance(), at the state.
MotionJacobian jacobian(const MotionModel& model, const PlanarState& state, double dt_s);

}  // namespace foretrack
