// SPDX-License-Identifier: Apache-2.0
// The part of the metrics that judges intentions and predicted paths.
#pragma once

#include "services/offline/flight/metrics.hpp"

namespace foretrack {

/// Fills in the fields from brier to foresight_error_m. Rows without an estimate do not count.
void measure_intention(std::span<const FlightRow> rows, Metrics& metrics);

}  // namespace foretrack
