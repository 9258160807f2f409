// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "services/offline/flight/flight_truth.hpp"
#include "services/offline/flight/intention_metrics.hpp"
#include "services/offline/flight/people_metrics.hpp"

namespace foretrack {
namespace {

using Rows = std::span<const FlightRow>;

double step_of(Rows rows) {
  return (rows.back().now_s - rows.front().now_s) / static_cast<double>(rows.size() - 1);
}

template <class Condition>
double share(Rows rows, Condition&& holds) {
  const auto count = std::count_if(rows.begin(), rows.end(), holds);
  return static_cast<double>(count) / static_cast<double>(rows.size());
}

// Durations of the runs in which the condition holds.
template <class Condition>
std::vector<double> runs_s(Rows rows, double step_s, Condition&& holds) {
  std::vector<double> runs;
  bool inside = false;
  for (const auto& row : rows) {
    const bool now = holds(row);
    if (now && !inside) runs.push_back(0.0);
    if (now) runs.back() += step_s;
    inside = now;
  }
  return runs;
}

double longest(const std::vector<double>& runs) {
  return runs.empty() ? 0.0 : *std::max_element(runs.begin(), runs.end());
}
double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

bool unseen(const FlightRow& row) {
  return !row.sight.visible();
}

Rows between(Rows rows, double from_s, double to_s) {
  const auto before = [](const FlightRow& row, double t) { return row.now_s < t; };
  const auto first = std::lower_bound(rows.begin(), rows.end(), from_s - 1e-9, before);
  const auto last = std::lower_bound(first, rows.end(), to_s + 1e-9, before);
  return {first, last};
}

double least_distance_m(Rows rows) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& row : rows) least = std::min(least, row.distance_m());
  return least;
}

void measure_sight(Rows rows, const MetricParams& p, Metrics& m) {
  const auto near = [&](const FlightRow& r) { return r.distance_m() < p.near_m; };
  m.failure_rate = share(rows, [&](const FlightRow& r) { return unseen(r) || near(r); });
  m.fov_loss_rate = share(rows, [](const FlightRow& r) { return !r.sight.in_view; });
  m.occlusion_rate = share(rows, [](const FlightRow& r) { return !r.sight.unhidden; });
  m.near_rate = share(rows, near);
  const auto losses = runs_s(rows, step_of(rows), unseen);
  m.losses = static_cast<int>(losses.size());
  m.longest_loss_s = longest(losses);
  m.mean_loss_s = mean(losses);
}

void measure_distance(Rows rows, const MetricParams& p, Metrics& m) {
  std::vector<double> errors;
  double sum_m = 0.0, square_m2 = 0.0, angle_rad = 0.0;
  for (const auto& row : rows) {
    const double d = row.distance_m();
    const double error = std::max({0.0, p.band_low_m - d, d - p.band_high_m});
    errors.push_back(error);
    sum_m += d;
    square_m2 += error * error;
    const Vec2 to_target = (row.target.position_enu_m - row.vehicle.position_enu_m).head<2>();
    angle_rad += std::abs(wrap_angle(yaw_of(to_target) - row.vehicle.yaw_rad()));
  }
  const auto n = static_cast<double>(rows.size());
  m.min_distance_m = least_distance_m(rows);
  m.mean_distance_m = sum_m / n;
  m.distance_error_mean_m = mean(errors);
  m.distance_error_rms_m = std::sqrt(square_m2 / n);
  m.view_angle_error_mean_rad = angle_rad / n;
  m.band_share = static_cast<double>(std::count(errors.begin(), errors.end(), 0.0)) / n;
  m.distance_error_p95_m = quantiles_of(std::move(errors)).p95;
}

void measure_safety(Rows rows, const MetricParams& p, Metrics& m) {
  const double step_s = step_of(rows);
  const auto contacts =
      runs_s(rows, step_s, [&](const FlightRow& r) { return r.clearance_m < p.vehicle_radius_m; });
  m.collisions = static_cast<int>(contacts.size());
  for (const double s : contacts) m.contact_s += s;
  m.min_clearance_m = std::numeric_limits<double>::infinity();
  double jerk2 = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const FlightRow& r = rows[i];
    const double v = r.vehicle.velocity_enu_m_s.norm(), a = r.acceleration_enu_m_s2.norm();
    const double w = std::abs(r.vehicle.angular_velocity_body_rad_s.z());
    m.min_clearance_m = std::min(m.min_clearance_m, r.clearance_m);
    m.max_speed_m_s = std::max(m.max_speed_m_s, v);
    m.max_acceleration_m_s2 = std::max(m.max_acceleration_m_s2, a);
    m.max_yaw_rate_rad_s = std::max(m.max_yaw_rate_rad_s, w);
    if (v > p.speed_max_m_s || a > p.acceleration_max_m_s2 || w > p.yaw_rate_max_rad_s)
      m.limit_violation_s += step_s;
    if (i > 0) jerk2 += (r.acceleration_enu_m_s2 - rows[i - 1].acceleration_enu_m_s2).squaredNorm();
  }
  m.smoothness_m2_s5 = jerk2 / (step_s * step_s) / static_cast<double>(rows.size() - 1);
}

bool collides(Rows rows, const MetricParams& p) {
  return std::any_of(rows.begin(), rows.end(),
                     [&](const FlightRow& r) { return r.clearance_m < p.vehicle_radius_m; });
}

EventRecord record_of(Rows window, double step_s, const TruthEvent& event, const MetricParams& p) {
  EventRecord record{.event = event};
  record.longest_loss_s = longest(runs_s(window, step_s, unseen));
  record.min_distance_m = least_distance_m(window);
  record.collided = collides(window, p);
  return record;
}

EventRecord judge_turn(Rows rows, const TruthEvent& event, const MetricParams& p) {
  EventRecord record =
      record_of(between(rows, event.begin_s - 1.0, event.begin_s + 4.0), step_of(rows), event, p);
  record.success = !record.collided && record.longest_loss_s <= p.turn_loss_s + 1e-9 &&
                   record.min_distance_m >= p.band_low_m - p.turn_distance_slack_m;
  return record;
}

EventRecord judge_deceleration(Rows window, double step_s, const TruthEvent& event,
                               const MetricParams& p) {
  EventRecord record = record_of(window, step_s, event, p);
  record.success = !record.collided && record.min_distance_m >= p.near_m;
  return record;
}

void measure_events(Rows rows, const std::vector<TruthEvent>& events, const MetricParams& p,
                    Metrics& m) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const TruthEvent& event : events) {
    if (event.kind != Intention::kDecelerate) {
      m.turn_records.push_back(judge_turn(rows, event, p));
      ++m.turns;
      m.turn_successes += m.turn_records.back().success;
      continue;
    }
    ++m.decelerations;
    const Rows window = between(rows, event.begin_s, event.begin_s + 3.0);
    least_m = std::min(least_m, least_distance_m(window));
    for (const auto& row : window)
      if (row.distance_m() < p.band_low_m) m.deceleration_below_band_s += step_of(rows);
    m.deceleration_records.push_back(judge_deceleration(window, step_of(rows), event, p));
  }
  m.turn_success_95 = wilson(m.turn_successes, m.turns);
  if (m.decelerations > 0) m.deceleration_min_distance_m = least_m;
}

}  // namespace

Quantiles quantiles_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto rank = [&](double q) {
    const auto k = static_cast<std::size_t>(std::ceil(q * static_cast<double>(values.size())));
    return values[std::clamp<std::size_t>(k, 1, values.size()) - 1];
  };
  return {rank(0.50), rank(0.95), rank(0.99), values.back()};
}

Interval95 wilson(int successes, int trials) {
  if (trials <= 0) return {};
  constexpr double z = 1.959963984540054;
  const double n = trials, share_of = successes / n;
  const double center = (share_of + z * z / (2.0 * n)) / (1.0 + z * z / n);
  const double half =
      z / (1.0 + z * z / n) * std::sqrt(share_of * (1.0 - share_of) / n + z * z / (4.0 * n * n));
  return {std::max(0.0, center - half), std::min(1.0, center + half)};
}

Metrics metrics_of(std::span<const FlightRow> rows, const MetricParams& params) {
  if (rows.size() < 2) throw std::invalid_argument("metrics_of: needs at least two rows");
  Metrics m;
  m.duration_s = step_of(rows) * static_cast<double>(rows.size());
  measure_sight(rows, params, m);
  measure_distance(rows, params, m);
  measure_safety(rows, params, m);
  measure_people(rows, params, m);
  const auto events = events_of(rows);
  measure_events(rows, events, params, m);
  measure_intention(rows, m);
  return m;
}

}  // namespace foretrack
