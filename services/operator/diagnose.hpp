// SPDX-License-Identifier: Apache-2.0
// Why does the vehicle not move? Walks the chain odometry → colour image → calibration → mount →
// detection → depth → flight controller → target → map → prediction → plan → gate and names what is
// wrong, first cause first.
#pragma once

#include <string>
#include <vector>

#include "services/operator/finding.hpp"
#include "services/operator/flight_snapshot.hpp"

namespace foretrack {

/// One finding at least for each link, in the order of the chain. The snapshot should be of a few
/// seconds, so that rates and ages mean something.
std::vector<Finding> diagnose(const FlightSnapshot& snapshot);

/// The first fault, or null.
const Finding* first_cause(const std::vector<Finding>& findings);

/// For people: a line per finding, the first cause again at the end.
std::string to_text(const std::vector<Finding>& findings);

}  // namespace foretrack
