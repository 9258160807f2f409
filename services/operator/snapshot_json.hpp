// SPDX-License-Identifier: Apache-2.0
// The flight as JSON, for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "services/operator/flight_snapshot.hpp"

namespace foretrack {

/// What is not known is left out.
nlohmann::ordered_json to_json(const FlightSnapshot& snapshot);
nlohmann::ordered_json to_json(const TopicFlow& flow);

}  // namespace foretrack
