// SPDX-License-Identifier: Apache-2.0
// What a flight was worth, as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "services/offline/flight/metrics.hpp"

namespace foretrack {

/// JSON has no infinity: null.
nlohmann::ordered_json finite_json(double value);
nlohmann::ordered_json json_of(const Quantiles& quantiles);

/// Indented; with the hash of the flight's log if there is one.
std::string json_of(const Metrics& metrics, std::string_view log_sha256 = {});

}  // namespace foretrack
