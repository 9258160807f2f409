// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/flight_truth.hpp"

namespace foretrack {

Truth truth_of(std::span<const FlightRow> rows) {
  Truth truth;
  truth.step_s = (rows.back().now_s - rows.front().now_s) / static_cast<double>(rows.size() - 1);
  for (const FlightRow& row : rows)
    truth.samples.push_back(
        {row.target.position_enu_m.head<2>(), row.target.velocity_enu_m_s.head<2>()});
  return truth;
}

std::vector<TruthEvent> events_of(std::span<const FlightRow> rows) {
  std::vector<TruthEvent> events = turns_and_stops_of(truth_of(rows));
  for (TruthEvent& event : events) {
    event.begin_s += rows.front().now_s;
    event.end_s += rows.front().now_s;
  }
  return events;
}

IntentionScorer score_intentions(std::span<const FlightRow> rows, const Truth& truth) {
  std::vector<SaidIntention> said;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].estimate.usable()) continue;
    SaidIntention& moment = said.emplace_back();
    moment.time_s = static_cast<double>(i) * truth.step_s;
    for (int k = 0; k < kIntentionCount; ++k) moment.p[k] = rows[i].beliefs[k].probability;
  }
  IntentionScorer scorer;
  scorer.add(said, truth);
  return scorer;
}

}  // namespace foretrack
