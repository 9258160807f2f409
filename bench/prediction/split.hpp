// SPDX-License-Identifier: Apache-2.0
// What is fitted on and what is held out: never the same world, nor the same pedestrian.
#pragma once

#include "bench/prediction/episodes.hpp"

namespace foretrack::bench {

inline std::vector<SimulatedWalk> fitting_turns() {
  return turning_walks(1, 8);
}
inline std::vector<SimulatedWalk> fitting_stops() {
  return stopping_walks(50001, 3);
}
inline std::vector<SimulatedWalk> fitting_returns() {
  return returning_walks(70001, 3);
}
inline std::vector<SimulatedWalk> held_out_turns() {
  return turning_walks(100001, 4);
}
inline std::vector<SimulatedWalk> held_out_stops() {
  return stopping_walks(150001, 3);
}
inline std::vector<SimulatedWalk> held_out_returns() {
  return returning_walks(170001, 3);
}
inline bool is_held_out(const RecordedWalk& walk) {
  return walk.pedestrian % 3 == 0;
}

}  // namespace foretrack::bench
