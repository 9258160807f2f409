// SPDX-License-Identifier: Apache-2.0
// How often the target has turned and stopped so far: who seldom did is less likely to now.
#pragma once

namespace foretrack {

/// Turns, stops, turns back and walked time, all forgotten over a minute. Owned by the caller of
/// predict().
struct WalkHabit {
  double turns = 0.0;
  double stops = 0.0;
  double turn_backs = 0.0;
  double walked_s = 0.0;
  double straight_s = 0.0;  // walked since the last turn
  bool turning = false;
  bool turning_back = false;
  bool standing = true;  // who stands at first has not stopped
  double stamp_s = 0.0;

  /// Logarithms of the turns, stops and turns back in a second of walking, as far as they can be
  /// told from what was seen.
  double log_turn_rate() const;
  double log_stop_rate() const;
  double log_turn_back_rate() const;
};

/// What one estimate says.
struct WalkMoment {
  double stamp_s = 0.0;
  double recent_turn_rad = 0.0;  // change of the course over the last second
  double speed_m_s = 0.0;
};

/// Follows one estimate. A gap is not walked time; a stamp that goes back starts anew.
void follow(WalkHabit& habit, const WalkMoment& moment, double walking_speed_m_s);

}  // namespace foretrack
