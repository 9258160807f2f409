// SPDX-License-Identifier: Apache-2.0
#include "services/offline/experiments/path_record.hpp"

#include "services/offline/flight/flight_truth.hpp"

namespace foretrack {
namespace {

constexpr double kEvery_s = 0.2;

}  // namespace

void PathRecord::add(const TargetState& target, const Prediction& prediction) {
  if (!target.usable()) return;
  const double rate_rad_s = heading_rate_.next(target.stamp_s, target.velocity_enu_m_s.head<2>());
  const bool early = !shown_.empty() && target.stamp_s < shown_.back().target.stamp_s + kEvery_s;
  if (!early) shown_.push_back({target, rate_rad_s, prediction});
}

PathScorer PathRecord::scores(std::span<const FlightRow> rows) const {
  PathScorer scorer;
  if (rows.size() < 2) return scorer;
  const Truth truth = truth_of(rows);
  for (const Shown& s : shown_)
    scorer.add(s.target, s.turn_rate_rad_s, s.prediction, truth,
               s.target.stamp_s - rows.front().now_s);
  return scorer;
}

}  // namespace foretrack
