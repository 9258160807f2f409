#include "services/flight/intention_metrics.hpp"

#include <cmath>

namespace foretrack {
namespace {

using Rows = std::span<const FlightRow>;

constexpr double kSure = 0.5;
constexpr double kEarliest_s = 2.0, kLatest_s = 1.0;  // of a warning, before and after the onset
constexpr int kTurnLeft = index_of(Intention::kTurnLeft);

bool has_belief(const FlightRow& row) {
  return row.estimate.usable();
}

// Mean of Σ_i (p_i − y_i)² over the labelled rows, and the same for the labels' own shares.
void score_probabilities(Rows rows, Metrics& m) {
  const auto labels = labels_of(rows);
  std::array<double, kIntentionCount> base{};
  int n = 0;
  double sum = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (labels[i] < 0 || !has_belief(rows[i])) continue;
    ++n;
    base[labels[i]] += 1.0;
    for (int k = 0; k < kIntentionCount; ++k)
      sum += std::pow(rows[i].beliefs[k].probability - (labels[i] == k ? 1.0 : 0.0), 2);
  }
  if (n == 0) return;
  m.brier = sum / n;
  m.brier_base = 1.0;
  for (const double count : base) m.brier_base -= (count / n) * (count / n);
}

// Times at which p of an intention rises above kSure.
std::vector<double> warnings_of(Rows rows, int intention) {
  std::vector<double> times;
  bool above = false;
  for (const auto& row : rows) {
    const bool now = has_belief(row) && row.beliefs[intention].probability > kSure;
    if (now && !above) times.push_back(row.now_s);
    above = now;
  }
  return times;
}

bool warns_of(double time_s, const TargetEvent& event) {
  return time_s >= event.begin_s - kEarliest_s && time_s <= event.end_s + kLatest_s;
}

void score_warnings(Rows rows, const std::vector<TargetEvent>& events, Metrics& m) {
  int false_alarms = 0;
  double lead_sum_s = 0.0;
  for (int kind = kTurnLeft; kind < kIntentionCount; ++kind) {
    const auto warnings = warnings_of(rows, kind);
    for (const double t : warnings) {
      bool right = false;
      for (const auto& e : events) right = right || (index_of(e.kind) == kind && warns_of(t, e));
      false_alarms += !right;
    }
    if (kind == index_of(Intention::kDecelerate)) continue;
    for (const auto& e : events) {
      if (index_of(e.kind) != kind) continue;
      for (const double t : warnings) {
        if (t < e.begin_s - kEarliest_s || t > e.begin_s + kLatest_s) continue;
        ++m.foreseen;
        lead_sum_s += e.begin_s - t;
        break;
      }
    }
  }
  if (m.foreseen > 0) m.lead_time_mean_s = lead_sum_s / m.foreseen;
  if (m.duration_s > 0.0) m.false_alarms_per_min = 60.0 * false_alarms / m.duration_s;
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

void measure_intention(Rows rows, const std::vector<TargetEvent>& events, Metrics& metrics) {
  score_probabilities(rows, metrics);
  score_warnings(rows, events, metrics);
  score_foresight(rows, metrics);
}

}  // namespace foretrack
