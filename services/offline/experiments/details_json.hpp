// SPDX-License-Identifier: Apache-2.0
// What the report of a bench draws, as JSON: details.json.
#pragma once

#include <string>

#include "services/offline/experiments/summarize.hpp"

namespace foretrack {

/// What the report draws: distance curves, maps of relative places, reliability, path errors, the
/// worst flight of each cell from above, and the commands that fly failed flights again.
std::string details_json_of(const BenchResults& results);

}  // namespace foretrack
