// SPDX-License-Identifier: Apache-2.0
// The places that see the target, and their visible regions.
#pragma once

#include "core/common/prediction.hpp"
#include "core/planning/see/target_belief.hpp"
#include "core/planning/see/visible_region.hpp"
#include "core/planning/stage_clock.hpp"
#include "core/planning/way/flight_path.hpp"

namespace foretrack {

/// V_k and V̂_k of one z_k.
struct View {
  bool seen = false;
  ViewSector visible;  // V_k
  ViewSector shrunk;   // V̂_k
};

/// Owned by the caller and reused.
struct LookAhead {
  SearchState search;
  WaypointPath way;
  std::array<std::vector<View>, kMaxIntentions> views;  // of each expected path
  bool target_seen = false;                             // some waypoint sees its z_k
  bool path_found = false;                              // some waypoint was reached
};

/// Paper §V.A, for each z_k of the likeliest path:
/// - The search for waypoint k goes on from waypoint k − 1.
/// - The visible region of z_k is found, and the intention's margins shrink it.
/// - The waypoint is turned into it.
/// The regions of the other paths are those around the same waypoints. A z_k that is merged with
/// one of a likelier path has no region. `assessment` may be null: there are no margins beyond the
/// least.
void look_ahead(const SearchContext& context, const Vec3& start_enu_m, const Vec3& start_velocity,
                const ExpectedTarget& expected, const IntentionAssessment* assessment,
                StageClock& clock, LookAhead& out);

}  // namespace foretrack
