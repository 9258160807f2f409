// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/flight_events.hpp"

#include <algorithm>

namespace foretrack {
namespace {

constexpr double kWalking_m_s = 0.3;
constexpr double kTurnRate_rad_s = 0.4;  // faster than this, the heading changes
constexpr double kLeastTurn_rad = rad(30.0);
constexpr double kGap_s = 0.3;         // shorter pauses do not part a turn in two
constexpr double kBraking_m_s2 = 0.5;  // harder than this, the speed falls

Vec2 velocity_of(const FlightRow& row) {
  return row.target.velocity_enu_m_s.head<2>();
}

double heading_change(const FlightRow& from, const FlightRow& to) {
  return wrap_angle(yaw_of(velocity_of(to)) - yaw_of(velocity_of(from)));
}

bool walks(const FlightRow& row) {
  return velocity_of(row).norm() > kWalking_m_s;
}

// Runs of rows of one turning sense, parted by more than kGap_s of straight walking.
std::vector<TargetEvent> turns_of(std::span<const FlightRow> rows) {
  std::vector<TargetEvent> turns;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (!walks(rows[i - 1]) || !walks(rows[i])) continue;
    const double change = heading_change(rows[i - 1], rows[i]);
    if (std::abs(change) < kTurnRate_rad_s * (rows[i].now_s - rows[i - 1].now_s)) continue;
    const Intention kind = change > 0.0 ? Intention::kTurnLeft : Intention::kTurnRight;
    const bool goes_on =
        !turns.empty() && turns.back().kind == kind && rows[i].now_s - turns.back().end_s < kGap_s;
    if (!goes_on) turns.push_back({.kind = kind, .begin_s = rows[i - 1].now_s});
    turns.back().end_s = rows[i].now_s;
    turns.back().turn_rad += change;
  }
  std::erase_if(turns, [](const TargetEvent& e) { return std::abs(e.turn_rad) < kLeastTurn_rad; });
  return turns;
}

// Runs of braking that take more than half of the speed.
std::vector<TargetEvent> decelerations_of(std::span<const FlightRow> rows) {
  std::vector<TargetEvent> found;
  for (std::size_t i = 1; i < rows.size();) {
    const double before = velocity_of(rows[i - 1]).norm();
    const auto brakes = [&](std::size_t k) {
      const double fall = velocity_of(rows[k - 1]).norm() - velocity_of(rows[k]).norm();
      return fall > kBraking_m_s2 * (rows[k].now_s - rows[k - 1].now_s);
    };
    std::size_t end = i;
    while (end < rows.size() && brakes(end)) ++end;
    const double last_speed = velocity_of(rows[std::max(end, i) - 1]).norm();
    if (end > i && before > kWalking_m_s && last_speed < 0.5 * before)
      found.push_back({Intention::kDecelerate, rows[i - 1].now_s, rows[end - 1].now_s, 0.0});
    i = std::max(end, i) + 1;
  }
  return found;
}

}  // namespace

std::vector<TargetEvent> events_of(std::span<const FlightRow> rows) {
  std::vector<TargetEvent> events = turns_of(rows);
  const auto decelerations = decelerations_of(rows);
  events.insert(events.end(), decelerations.begin(), decelerations.end());
  std::stable_sort(events.begin(), events.end(), [](const TargetEvent& a, const TargetEvent& b) {
    return a.begin_s < b.begin_s;
  });
  return events;
}

}  // namespace foretrack
