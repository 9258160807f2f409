// How often the target has turned so far: who seldom turns is less likely to turn now.
#pragma once

namespace foretrack {

/// Turns and walked time, both forgotten over a minute. Owned by the caller of predict().
struct TurnHabit {
  double turns = 0.0;
  double walked_s = 0.0;
  double straight_s = 0.0;  // walked since the last turn
  bool turning = false;
  double stamp_s = 0.0;

  /// Logarithm of the turns in a second, as far as they can be told from what was seen.
  double log_rate() const;
};

/// Follows one estimate. recent_turn_rad: change of the course over the last second. A gap is not
/// walked time; a stamp that goes back starts anew.
void follow(TurnHabit& habit, double stamp_s, double recent_turn_rad, bool walking);

}  // namespace foretrack
