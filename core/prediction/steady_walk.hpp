// Where the target is and how it walks, as its last second or two say together.
#pragma once

#include "core/prediction/motion_models.hpp"
#include "core/prediction/params.hpp"

namespace foretrack {

/// A line fitted to the estimates since the last manoeuvre, at most steady_memory_s old. A
/// tracker's filter must follow a turn at once, which leaves noise of 0.2 m/s in its velocity: 0.6
/// m after 3 s of walking straight on. Owned by the caller of predict().
struct SteadyWalk {
  bool started = false;
  double stamp_s = 0.0;
  double memory_s = 0.0;   // that the line reaches back
  double manoeuvre = 0.0;  // in [0, 1]; 1: the past tells nothing of the present walk
  PlanarState line;

  /// The line where the walk is steady, what was measured in a manoeuvre, and between them else.
  PlanarState state(const PlanarState& measured) const;
};

/// Follows one estimate. body_swing_rad: how far the chest turned lately, which tells of a
/// manoeuvre before the velocity does; 0: not known. A stamp that goes back or a gap starts anew.
void follow(SteadyWalk& walk, const PlanarState& measured, double stamp_s, double body_swing_rad,
            const PredictionParams& params);

}  // namespace foretrack
