// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/fleet_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace foretrack {
namespace {

using FleetRows = std::span<const FleetRow>;
constexpr double kBefore_s = 1.0, kAfter_s = 4.0;

double fleet_step_s(FleetRows rows) {
  return rows.size() < 2
             ? 0.0
             : (rows.back().now_s - rows.front().now_s) / static_cast<double>(rows.size() - 1);
}

int seeing(const FleetRow& row) {
  return static_cast<int>(std::count_if(row.members.begin(), row.members.end(),
                                        [](const auto& m) { return m.there && m.sees; }));
}

double longest_unseen_s(FleetRows rows, double step_s) {
  double longest = 0.0, now = 0.0;
  for (const FleetRow& row : rows) {
    now = seeing(row) == 0 ? now + step_s : 0.0;
    longest = std::max(longest, now);
  }
  return longest;
}

// Calls take(a, b) for all pairs that are there.
template <class Take>
void for_pairs(const FleetRow& row, const Take& take) {
  for (std::size_t a = 0; a < row.members.size(); ++a)
    for (std::size_t b = a + 1; b < row.members.size(); ++b)
      if (row.members[a].there && row.members[b].there) take(row.members[a], row.members[b]);
}

void measure_sight(FleetRows rows, const FleetMetricParams& p, FleetMetrics& m) {
  double time = 0.0, hidden = 0.0, one = 0.0, two = 0.0, band = 0.0;
  for (const FleetRow& row : rows) {
    const int n = seeing(row);
    one += n >= 1;
    two += n >= 2;
    bool in_band = false;
    for (const FleetRowMember& member : row.members) {
      if (!member.there) continue;
      time += 1.0;
      hidden += member.peer_hides;
      in_band |= member.distance_m >= p.band_low_m && member.distance_m <= p.band_high_m;
    }
    band += in_band;
  }
  const auto count = static_cast<double>(rows.size());
  m.union_visibility = one / count;
  m.k2_visibility = two / count;
  m.band_share = band / count;
  m.mutual_occlusion = time > 0.0 ? hidden / time : 0.0;
}

void measure_separation(FleetRows rows, const FleetMetricParams& p, FleetMetrics& m) {
  const double step_s = fleet_step_s(rows);
  m.min_separation_m = std::numeric_limits<double>::infinity();
  bool touched = false;
  for (const FleetRow& row : rows) {
    double least_m = std::numeric_limits<double>::infinity();
    bool stacked = false;
    for_pairs(row, [&](const FleetRowMember& a, const FleetRowMember& b) {
      const Vec3 d = a.position_enu_m - b.position_enu_m;
      least_m = std::min(least_m, d.norm() - 2.0 * p.vehicle_radius_m);
      stacked |= d.head<2>().norm() < 2.0 * p.vehicle_radius_m && std::abs(d.z()) < p.downwash_m;
    });
    m.min_separation_m = std::min(m.min_separation_m, least_m);
    if (least_m < p.separation_m) m.below_separation_s += step_s;
    if (stacked) m.stacked_s += step_s;
    m.contacts += least_m < 0.0 && !touched;
    touched = least_m < 0.0;
  }
}

// The least angle between neighbours as the person sees them, of what it is when all are even.
void measure_spread(FleetRows rows, FleetMetrics& m) {
  double sum = 0.0;
  int counted = 0;
  for (const FleetRow& row : rows) {
    std::vector<double> bearings;
    for (const FleetRowMember& member : row.members)
      if (member.there)
        bearings.push_back(yaw_of(Vec2((member.position_enu_m - row.person_enu_m).head<2>())));
    if (bearings.size() < 2) continue;
    double least = 2.0 * kPi;
    for (std::size_t a = 0; a < bearings.size(); ++a)
      for (std::size_t b = a + 1; b < bearings.size(); ++b)
        least = std::min(least, std::abs(wrap_angle(bearings[a] - bearings[b])));
    sum += least / (2.0 * kPi / static_cast<double>(bearings.size()));
    ++counted;
  }
  m.separation_score = counted > 0 ? sum / counted : 0.0;
}

int near_of(const FleetRow& row) {
  for (std::size_t i = 0; i < row.members.size(); ++i)
    if (row.members[i].there && row.members[i].is_near) return static_cast<int>(i);
  return -1;
}

void measure_handovers(FleetRows rows, FleetMetrics& m) {
  int before = -1;
  for (const FleetRow& row : rows) {
    const int now = near_of(row);
    if (now < 0) continue;
    m.handovers += before >= 0 && now != before;
    before = now;
  }
}

FleetRows fleet_rows_between(FleetRows rows, double from_s, double to_s) {
  const auto before = [](const FleetRow& row, double t) { return row.now_s < t; };
  const auto first = std::lower_bound(rows.begin(), rows.end(), from_s, before);
  return {first, std::lower_bound(first, rows.end(), to_s, before)};
}

}  // namespace

FleetMetricParams fleet_metric_params_of(const MetricParams& metrics, const FleetParams& params) {
  return {.vehicle_radius_m = metrics.vehicle_radius_m,
          .separation_m = params.separation_m,
          .downwash_m = params.downwash_m,
          .band_low_m = metrics.band_low_m,
          .band_high_m = metrics.band_high_m};
}

bool hides(const Vec3& hull_enu_m, const Vec3& eye_enu_m, const Vec3& person_enu_m) {
  constexpr double kSlack_m = 0.4;  // a hull that is nearer to the line hides
  const Vec3 way = person_enu_m - eye_enu_m;
  const double along = (hull_enu_m - eye_enu_m).dot(way) / way.squaredNorm();
  return along > 0.0 && along < 1.0 && (eye_enu_m + along * way - hull_enu_m).norm() < kSlack_m;
}

FleetMetrics fleet_metrics_of(FleetRows rows, std::span<const TruthEvent> events,
                              const FleetMetricParams& params) {
  FleetMetrics m;
  if (rows.empty()) return m;
  const double step_s = fleet_step_s(rows);
  m.vehicles = static_cast<int>(rows.front().members.size());
  measure_sight(rows, params, m);
  m.longest_unseen_s = longest_unseen_s(rows, step_s);
  measure_separation(rows, params, m);
  measure_spread(rows, m);
  measure_handovers(rows, m);
  double bytes = 0.0, there_s = 0.0;
  for (const FleetRow& row : rows) {
    bytes += row.told_bytes;
    for (const FleetRowMember& member : row.members) there_s += member.there ? step_s : 0.0;
  }
  m.bytes_per_s = there_s > 0.0 ? bytes / there_s : 0.0;
  for (const TruthEvent& event : events)
    m.events.push_back(
        {event.begin_s, longest_unseen_s(fleet_rows_between(rows, event.begin_s - kBefore_s,
                                                            event.begin_s + kAfter_s),
                                         step_s)});
  return m;
}

}  // namespace foretrack
