// SPDX-License-Identifier: Apache-2.0
#include "core/planning/search/search_params.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack {

double safe_speed_m_s(double free_m, double person_speed_m_s, const SearchParams& p) {
  // v²/2a + v (r + w/a) + w r + gap = free, for the vehicle's v and the person's w.
  const double b = p.search_reaction_s * p.search_braking_m_s2 + person_speed_m_s;
  const double room_m = free_m - p.search_gap_m - person_speed_m_s * p.search_reaction_s;
  if (room_m <= 0.0) return 0.0;
  return std::sqrt(b * b + 2.0 * p.search_braking_m_s2 * room_m) - b;
}

ParamRows rows(SearchParams& p) {
  return {
      {"search_sight_m", &p.search_sight_m, "m", 1.0, 20.0,
       "so far the camera would find a person who is in view"},
      {"search_walk_speed_m_s", &p.search_walk_speed_m_s, "m/s", 0.1, 5.0,
       "of somebody who stood when they were lost"},
      {"search_miss_per_look", &p.search_miss_per_look, "", 0.0, 1.0,
       "share of looks, 0.1 s apart, that miss a person in view"},
      {"search_patience_s", &p.search_patience_s, "s", 0.5, 60.0,
       "to see them so much later is worth 1 / e"},
      {"search_near_m", &p.search_near_m, "m", 0.5, 10.0,
       "so far a person could come within a step or two"},
      {"search_reaction_s", &p.search_reaction_s, "s", 0.0, 2.0,
       "from the person's appearance until the vehicle brakes"},
      {"search_braking_m_s2", &p.search_braking_m_s2, "m/s2", 0.5, 20.0,
       "with which it then stops"},
      {"search_gap_m", &p.search_gap_m, "m", 0.0, 5.0,
       "from centre to centre, left when both have come near"},
  };
}

}  // namespace foretrack
