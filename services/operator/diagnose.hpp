// SPDX-License-Identifier: Apache-2.0
// Why does the vehicle not move? Walks the chain sensor → target → map → prediction → plan → gate
// → autopilot and names what is wrong, first cause first.
#pragma once

#include <string>
#include <vector>

#include "services/operator/flight_snapshot.hpp"

namespace foretrack {

struct Finding {
  enum class Level { kFine, kNote, kFault };
  Level level = Level::kFine;
  std::string stage;   // "vehicle", "camera", "target", "map", … or "set-up"
  std::string text;    // one sentence, plain words
  std::string advice;  // what to do; may be empty
};

/// One finding at least for each link, in the order of the chain. The snapshot should be of a few
/// seconds, so that rates and ages mean something.
std::vector<Finding> diagnose(const FlightSnapshot& snapshot);

/// The first fault, or null.
const Finding* first_cause(const std::vector<Finding>& findings);

/// For people: a line per finding, the first cause again at the end.
std::string to_text(const std::vector<Finding>& findings);

}  // namespace foretrack
