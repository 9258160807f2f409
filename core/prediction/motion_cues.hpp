// SPDX-License-Identifier: Apache-2.0
// What the target's track alone says about its intention.
#pragma once

#include <array>

#include "core/common/target.hpp"
#include "core/prediction/chest_offset.hpp"
#include "core/prediction/params.hpp"
#include "core/prediction/short_term_trust.hpp"
#include "core/prediction/walk_habit.hpp"

namespace foretrack {

/// What was seen of the target. Owned by the caller of predict().
struct MotionMemory {
  MotionHistory history;
  WalkHabit habit;
  ChestOffset chest;
  ShortTermTrust trust;
};

/// What the target's motion so far says of its intention.
struct MotionCues {
  PlanarState measured;        // as the tracker says
  PlanarState state;           // as the last moments tell
  PlanarState soon;            // ShortTermMotion::kSoon_s later, as far as it shows already
  double manoeuvre = 0.0;      // in [0, 1]: how far the walk is from a steady one
  double soon_turn_rad = 0.0;  // of the velocity, from now until soon; 0 when not walking
  double soon_fall_m_s = 0.0;  // of the speed, the same
  double height_m = 0.0;       // of the target's position
  double speed_m_s = 0.0;
  bool walking = false;      // fast enough for its velocity to have a direction
  double heading_rad = 0.0;  // of the velocity; of the chest when not walking
  bool body_known = false;
  double chest_rad = 0.0;      // less its steady offset from the course; NaN: not known
  double chest_trust = 1.0;    // in [0, 1]: how far it is worth reading
  double body_turn_rad = 0.0;  // r_bv (eq. 3), of the measured velocity, wrapped; 0: not known
  double steady_body_turn_rad = 0.0;  // its mean over the last moments: noise is about 10°
  // Change of the chest's yaw over the last moments: unlike r_bv it does not wait for the velocity,
  // which a filter delays, and is over when the turn is.
  static constexpr std::array<double, 3> kSwing_s = {0.16, 0.32, 0.64};
  static constexpr std::size_t kTellingSwing = 1;  // more than noise, soon enough
  std::array<double, 3> body_swing_rad{};
  double speed_fall_m_s = 0.0;  // ‖V(t − Δt)‖ − ‖V(t)‖
  static constexpr std::array<double, 2> kFall_s = {0.12, 0.24};
  std::array<double, 2> recent_fall_m_s{};  // the same over shorter times
  double turn_rate_rad_s = 0.0;             // of the velocity, over the same interval
  double recent_turn_rad = 0.0;             // of the velocity, over the last second
  double log_turns_per_s = 0.0;             // as often as the target has turned so far
  double log_stops_per_s = 0.0;             // the same of stops
  double straight_s = 0.0;                  // walked since its last turn
  double log_turn_backs_per_s = 0.0;        // as often as it has turned back so far
  Gait gait;
};

/// The cues as they are of somebody whose chest is not seen.
MotionCues without_chest(MotionCues cues);

/// Adds the target to the memory and reads the cues.
MotionCues observe_motion(MotionMemory& memory, const TargetState& target,
                          const PredictionParams& params);

}  // namespace foretrack
