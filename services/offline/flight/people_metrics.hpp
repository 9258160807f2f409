// SPDX-License-Identifier: Apache-2.0
// The part of the metrics that says how near people the vehicle came.
#pragma once

#include "services/offline/flight/metrics.hpp"

namespace foretrack {

/// Between the hulls, in space: the vehicle's ball and the person's upright cylinder.
double gap_m(const FlightRow& row, const PersonTruth& person, double vehicle_radius_m);

/// The vehicle is above where it usually flies, or climbs, with somebody below or beside it.
bool evades_upward(const FlightRow& row, const MetricParams& params);

/// Fills in the fields from person_contacts to unseen_rate_not_evading.
void measure_people(std::span<const FlightRow> rows, const MetricParams& params, Metrics& metrics);

}  // namespace foretrack
