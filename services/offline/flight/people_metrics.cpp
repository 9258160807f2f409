// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/people_metrics.hpp"

#include <algorithm>

#include "core/common/moving_body.hpp"

namespace foretrack {
namespace {

constexpr double kEvadedWithin_m = 2.0;  // horizontally: somebody further off is not evaded
constexpr double kAboveUsual_m = 0.5;
constexpr double kClimb_m_s = 0.5;

struct Nearness {
  int contacts = 0;
  double least_m = std::numeric_limits<double>::infinity();
  bool touches = false;

  void add(double gap) {
    contacts += gap <= 0.0 && !touches;
    touches = gap <= 0.0;
    least_m = std::min(least_m, gap);
  }
};

void measure_gaps(std::span<const FlightRow> rows, double radius_m, Metrics& m) {
  Nearness followed;
  std::vector<Nearness> others(rows.front().bystanders.size());
  for (const FlightRow& row : rows) {
    followed.add(gap_m(row, row.followed(), radius_m));
    for (std::size_t i = 0; i < others.size(); ++i)
      others[i].add(gap_m(row, row.bystanders[i], radius_m));
  }
  m.person_contacts = followed.contacts;
  m.min_person_gap_m = followed.least_m;
  for (const Nearness& other : others) {
    m.bystander_contacts += other.contacts;
    m.min_bystander_gap_m = std::min(m.min_bystander_gap_m, other.least_m);
  }
}

}  // namespace

double gap_m(const FlightRow& row, const PersonTruth& person, double vehicle_radius_m) {
  return gap_m(row.vehicle.position_enu_m, vehicle_radius_m, person.foot_enu_m, kPersonRadius_m,
               person.height_m);
}

bool evades_upward(const FlightRow& row, const MetricParams& params) {
  const double usual_m = row.target.position_enu_m.z() + params.height_above_target_m;
  if (row.vehicle.position_enu_m.z() < usual_m + kAboveUsual_m &&
      row.vehicle.velocity_enu_m_s.z() < kClimb_m_s)
    return false;
  const auto is_near = [&](const PersonTruth& person) {
    return distance_xy(row.vehicle.position_enu_m, person.foot_enu_m) < kEvadedWithin_m;
  };
  return is_near(row.followed()) ||
         std::any_of(row.bystanders.begin(), row.bystanders.end(), is_near);
}

void measure_people(std::span<const FlightRow> rows, const MetricParams& params, Metrics& m) {
  measure_gaps(rows, params.vehicle_radius_m, m);
  const double step_s = m.duration_s / static_cast<double>(rows.size());
  double unseen = 0.0, near = 0.0, failed = 0.0, other = 0.0;  // rows that do not evade
  for (const FlightRow& row : rows) {
    if (evades_upward(row, params)) {
      m.evading_s += step_s;
      continue;
    }
    const bool is_unseen = !row.sight.visible(), is_near = row.distance_m() < params.near_m;
    ++other;
    unseen += is_unseen;
    near += is_near;
    failed += is_unseen || is_near;
  }
  m.failure_rate_not_evading = failed / std::max(other, 1.0);
  m.near_rate_not_evading = near / std::max(other, 1.0);
  m.unseen_rate_not_evading = unseen / std::max(other, 1.0);
}

}  // namespace foretrack
