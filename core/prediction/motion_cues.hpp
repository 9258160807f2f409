// What the target's track alone says about its intention.
#pragma once

#include <array>

#include "core/common/target.hpp"
#include "core/prediction/motion_models.hpp"
#include "core/prediction/params.hpp"
#include "core/prediction/steady_walk.hpp"
#include "core/prediction/turn_habit.hpp"

namespace foretrack {

/// The last second or so of states, thinned to 50 a second. Owned by the caller of predict().
struct MotionHistory {
  struct Sample {
    double stamp_s = 0.0;
    Vec2 velocity_m_s = Vec2::Zero();
    double body_turn_rad = 0.0;  // r_bv
    double body_yaw_rad = 0.0;   // NaN: not known
  };
  static constexpr int kCapacity = 64;
  std::array<Sample, kCapacity> samples{};
  int newest = 0;
  int count = 0;
  SteadyWalk walk;
  TurnHabit habit;

  /// i = 0: the newest.
  const Sample& back(int i) const { return samples[(newest - i + kCapacity) % kCapacity]; }
};

struct MotionCues {
  PlanarState measured;    // as the tracker says
  PlanarState state;       // smoothed where the walk is steady
  double manoeuvre = 0.0;  // in [0, 1]: how little the past says of it
  double height_m = 0.0;   // of the target's position
  double speed_m_s = 0.0;
  bool walking = false;      // fast enough for its velocity to have a direction
  double heading_rad = 0.0;  // of the velocity; of the chest when not walking
  bool body_known = false;
  double body_turn_rad = 0.0;         // r_bv (eq. 3), wrapped; 0 when not walking or not known
  double steady_body_turn_rad = 0.0;  // its mean over the last moments: noise is about 10°
  // Change of the chest's yaw over the last moments: unlike r_bv it does not wait for the velocity,
  // which a filter delays, and is over when the turn is.
  static constexpr std::array<double, 3> kSwing_s = {0.16, 0.32, 0.64};
  static constexpr std::size_t kTellingSwing = 1;  // more than noise, soon enough
  std::array<double, 3> body_swing_rad{};
  double speed_fall_m_s = 0.0;  // ‖V(t − Δt)‖ − ‖V(t)‖
  static constexpr std::array<double, 2> kFall_s = {0.12, 0.24};
  std::array<double, 2> recent_fall_m_s{};  // the same over shorter times
  Vec2 acceleration_m_s2 = Vec2::Zero();    // beyond what noise of the velocity looks like
  double turn_rate_rad_s = 0.0;             // of the velocity, over the same interval
  double recent_turn_rad = 0.0;             // of the velocity, over the last second
  double log_turns_per_s = 0.0;             // as often as the target has turned so far
  double straight_s = 0.0;                  // walked since its last turn
};

/// Adds the target to the history and reads the cues. A stamp that goes back, or a gap of more than
/// a second, starts the history anew.
MotionCues observe_motion(MotionHistory& history, const TargetState& target,
                          const PredictionParams& params);

}  // namespace foretrack
