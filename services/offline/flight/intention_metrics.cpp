// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/intention_metrics.hpp"

#include <cmath>

#include "services/offline/flight/flight_truth.hpp"

namespace foretrack {
namespace {

using Rows = std::span<const FlightRow>;

void score_probabilities(Rows rows, Metrics& m) {
  const IntentionReport report = score_intentions(rows, truth_of(rows)).report();
  m.brier = report.brier;
  m.brier_base = report.base_brier;
  m.foreseen = report.turns.by_onset;
  m.lead_time_median_s = report.turns.median_lead_s;
  m.false_alarms_per_min = report.turns.false_alarms_per_min;
}

// Foresight counts from the prediction's own stamp, which is that of the estimate.
void score_foresight(Rows rows, Metrics& m) {
  const double first_s = rows.front().now_s;
  const double step_s = (rows.back().now_s - first_s) / static_cast<double>(rows.size() - 1);
  for (std::size_t k = 0; k < kForesight_s.size(); ++k) {
    double sum_m = 0.0;
    int n = 0;
    for (const auto& row : rows) {
      const double then_s = row.estimate.stamp_s + kForesight_s[k];
      const double index = std::round((then_s - first_s) / step_s);
      if (!row.planned || row.foresight_m[k].hasNaN()) continue;
      if (index < 0.0 || index >= static_cast<double>(rows.size())) continue;
      const FlightRow& then = rows[static_cast<std::size_t>(index)];
      sum_m += (then.target.position_enu_m.head<2>() - row.foresight_m[k]).norm();
      ++n;
    }
    if (n > 0) m.foresight_error_m[k] = sum_m / n;
  }
}

}  // namespace

void measure_intention(Rows rows, Metrics& metrics) {
  score_probabilities(rows, metrics);
  score_foresight(rows, metrics);
}

}  // namespace foretrack
