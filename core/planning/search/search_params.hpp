// SPDX-License-Identifier: Apache-2.0
// Parameters of the search for a person who was lost.
#pragma once

#include "core/common/params.hpp"

namespace foretrack {

/// How the person may move unseen, how well the camera finds them, how fast is safe.
struct SearchParams {
  double search_sight_m = 6.0;         ///< so far the camera would find a person who is in view
  double search_walk_speed_m_s = 1.2;  ///< of somebody who stood when they were lost
  double search_miss_per_look = 0.5;   ///< share of looks, 0.1 s apart, that miss a person in view
  double search_patience_s = 10.0;     ///< to see them so much later is worth 1 / e
  double search_near_m = 3.0;          ///< so far a person could come within a step or two
  double search_reaction_s = 0.3;      ///< from the person's appearance until the vehicle brakes
  double search_braking_m_s2 = 3.0;    ///< with which it then stops
  double search_gap_m = 1.0;           ///< from centre to centre, left when both have come near
};
/// One row for each field: name, unit, range, meaning.
ParamRows rows(SearchParams& params);

/// How fast the vehicle may fly where nobody can be nearer ahead than that: it sees them, brakes,
/// and they come to meet it meanwhile. Never below 0.
double safe_speed_m_s(double free_m, double person_speed_m_s, const SearchParams& params);

}  // namespace foretrack
