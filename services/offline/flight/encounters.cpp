// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/encounters.hpp"

#include <algorithm>

#include "services/offline/flight/people_metrics.hpp"

namespace foretrack {
namespace {

using Rows = std::span<const FlightRow>;

constexpr double kWithin_m = 1.5, kAhead_s = 4.0, kOver_s = 1.0;
constexpr double kClosing_m_s = 0.3;   // slower, nobody comes
constexpr double kMoved_m = 0.15;      // less is not an evasion
constexpr double kStanding_m_s = 0.3;  // slower, the vehicle hovers
constexpr double kBeyondBand_m = 0.5;
constexpr double kInTheWay_m = 1.0;  // gap

PersonTruth person_of(const FlightRow& row, int person) {
  return person == 0 ? row.followed() : row.bystanders[static_cast<std::size_t>(person - 1)];
}

// Both go straight on: the least horizontal distance within kAhead_s.
bool comes_near(const FlightRow& row, const PersonTruth& person) {
  const Vec2 apart = (person.foot_enu_m - row.vehicle.position_enu_m).head<2>();
  const Vec2 closing = (person.velocity_enu_m_s - row.vehicle.velocity_enu_m_s).head<2>();
  const double distance_m = apart.norm();
  if (-apart.dot(closing) < kClosing_m_s * std::max(distance_m, 1e-6)) return false;
  const double at_s = std::min(-apart.dot(closing) / closing.squaredNorm(), kAhead_s);
  return (apart + at_s * closing).norm() < kWithin_m;
}

// [first, last] rows of each encounter with one person.
std::vector<std::pair<std::size_t, std::size_t>> spans_of(Rows rows, int person) {
  std::vector<std::pair<std::size_t, std::size_t>> spans;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!comes_near(rows[i], person_of(rows[i], person))) continue;
    const bool goes_on =
        !spans.empty() && rows[i].now_s - rows[spans.back().second].now_s < kOver_s;
    if (!goes_on) spans.push_back({i, i});
    spans.back().second = i;
  }
  // The moments after the course has changed belong to it: the gap may still be shrinking.
  for (std::size_t k = 0; k < spans.size(); ++k) {
    const std::size_t limit = k + 1 < spans.size() ? spans[k + 1].first - 1 : rows.size() - 1;
    std::size_t& last = spans[k].second;
    const double end_s = rows[last].now_s + kOver_s;
    while (last < limit && rows[last].now_s < end_s) ++last;
  }
  return spans;
}

Evasion evasion_of(const FlightRow& from, const FlightRow& to, const PersonTruth& person) {
  const Vec3 moved = to.vehicle.position_enu_m - from.vehicle.position_enu_m;
  const Vec2 apart = (from.vehicle.position_enu_m - person.foot_enu_m).head<2>();
  const Vec2 course = person.velocity_enu_m_s.head<2>();
  const Vec2 way = course.norm() > kStanding_m_s ? course.normalized() : apart.normalized();
  const double along_m = moved.head<2>().dot(way);
  const double aside_m = std::abs(moved.x() * way.y() - moved.y() * way.x());
  const double up_m = moved.z();
  const double most_m = std::max({along_m, aside_m, up_m});
  if (most_m < kMoved_m) return Evasion::kStayed;
  if (most_m == up_m) return Evasion::kUp;
  return most_m == along_m ? Evasion::kBack : Evasion::kAside;
}

EncounterRecord record_of(Rows rows, int person, const MetricParams& params) {
  EncounterRecord e{.person = person};
  e.begin_s = rows.front().now_s;
  e.end_s = rows.back().now_s;
  e.least_gap_m = std::numeric_limits<double>::infinity();
  const double step_s = rows.size() > 1 ? rows[1].now_s - rows[0].now_s : 0.0;
  std::size_t least = 0;
  double loss_s = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const PersonTruth truth = person_of(rows[i], person);
    const double gap = gap_m(rows[i], truth, params.vehicle_radius_m);
    if (gap < e.least_gap_m) {
      e.least_gap_m = gap;
      least = i;
    }
    e.person_speed_m_s = std::max(e.person_speed_m_s, truth.velocity_enu_m_s.head<2>().norm());
    e.wall_contact |= rows[i].clearance_m < params.vehicle_radius_m;
    const bool evades = evades_upward(rows[i], params);
    if (evades) e.evading_s += step_s;
    loss_s = rows[i].sight.visible() || evades ? 0.0 : loss_s + step_s;
    e.longest_loss_s = std::max(e.longest_loss_s, loss_s);
  }
  for (std::size_t i = 0; i <= least; ++i) e.seen |= person_of(rows[i], person).in_sight;
  e.least_gap_s = rows[least].now_s;
  e.evasion = evasion_of(rows.front(), rows[least], person_of(rows.front(), person));
  return e;
}

bool hovers(const FlightRow& row, const MetricParams& params) {
  if (row.vehicle.velocity_enu_m_s.norm() > kStanding_m_s ||
      row.distance_m() < params.band_high_m + kBeyondBand_m)
    return false;
  return std::none_of(row.bystanders.begin(), row.bystanders.end(), [&](const PersonTruth& p) {
    return gap_m(row, p, params.vehicle_radius_m) < kInTheWay_m;
  });
}

}  // namespace

double gap_floor_m(double person_speed_m_s) {
  constexpr double kSlack_m_s = 0.02;  // a walk's rounding
  if (person_speed_m_s <= 1.5 + kSlack_m_s) return 0.5;
  return person_speed_m_s <= 2.0 + kSlack_m_s ? 0.3 : 0.0;
}

std::vector<EncounterRecord> encounters_of(Rows rows, const MetricParams& params) {
  std::vector<EncounterRecord> encounters;
  const int people = 1 + static_cast<int>(rows.front().bystanders.size());
  for (int person = 0; person < people; ++person)
    for (const auto& [first, last] : spans_of(rows, person))
      encounters.push_back(record_of(rows.subspan(first, last - first + 1), person, params));
  std::stable_sort(encounters.begin(), encounters.end(),
                   [](const auto& a, const auto& b) { return a.begin_s < b.begin_s; });
  return encounters;
}

double longest_hover_s(Rows rows, const MetricParams& params) {
  double longest_s = 0.0, run_s = 0.0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    run_s = hovers(rows[i], params) ? run_s + rows[i].now_s - rows[i - 1].now_s : 0.0;
    longest_s = std::max(longest_s, run_s);
  }
  return longest_s;
}

}  // namespace foretrack
