// SPDX-License-Identifier: Apache-2.0
#include "core/scores/truth.hpp"

#include <algorithm>

namespace foretrack {
namespace {

constexpr double kWalking_m_s = 0.3;
constexpr double kTurned_rad = rad(30.0), kTurnAhead_s = 1.0;
constexpr double kTurnedBack_rad = rad(120.0), kTurnBackAhead_s = 2.0;
constexpr double kReversing_m_s = 0.15;  // slower still, and a motion has no direction
constexpr double kStopAhead_s = 1.0;

double heading_change(const TruthSample& from, const TruthSample& to) {
  return wrap_angle(yaw_of(to.velocity_m_s) - yaw_of(from.velocity_m_s));
}

bool is_known(const Truth& truth, int i, double ahead_s) {
  return i + truth.steps(ahead_s) < truth.count() && truth.samples[i].speed_m_s() > kWalking_m_s;
}

// Index of the first sample of the next ahead_s whose heading differs by so much; −1: none.
int heading_after(const Truth& truth, int i, double ahead_s, double change_rad,
                  double least_speed_m_s) {
  const auto& s = truth.samples;
  const int last = std::min(i + truth.steps(ahead_s), truth.count() - 1);
  for (int j = i + 1; j <= last; ++j)
    if (s[j].speed_m_s() > least_speed_m_s && std::abs(heading_change(s[i], s[j])) > change_rad)
      return j;
  return -1;
}
int turn_after(const Truth& truth, int i) {
  return heading_after(truth, i, kTurnAhead_s, kTurned_rad, kWalking_m_s);
}

// The same for a speed that halves.
int stop_after(const Truth& truth, int i) {
  const auto& s = truth.samples;
  for (int j = i + 1; j <= i + truth.steps(kStopAhead_s); ++j)
    if (s[j].speed_m_s() < 0.5 * s[i].speed_m_s()) return j;
  return -1;
}

Intention side_of(double turn_rad) {
  return turn_rad > 0.0 ? Intention::kTurnLeft : Intention::kTurnRight;
}

}  // namespace

std::optional<Intention> label_at(const Truth& truth, int i) {
  if (!is_known(truth, i, kTurnBackAhead_s)) return std::nullopt;
  const auto& s = truth.samples;
  if (heading_after(truth, i, kTurnBackAhead_s, kTurnedBack_rad, kReversing_m_s) >= 0)
    return Intention::kTurnBack;
  if (const int j = turn_after(truth, i); j >= 0) return side_of(heading_change(s[i], s[j]));
  const int slow = stop_after(truth, i);
  if (slow < 0) return Intention::kForward;
  if (!is_known(truth, slow, kTurnAhead_s)) return Intention::kDecelerate;
  const int turned = turn_after(truth, slow);  // slow because of a turn
  return turned < 0 ? Intention::kDecelerate : side_of(heading_change(s[i], s[turned]));
}

bool sets_off(const Truth& truth, int i) {
  constexpr double kStands_m_s = 0.2, kWalks_m_s = 0.5, kAhead_s = 1.0;
  const auto& s = truth.samples;
  const int last = i + truth.steps(kAhead_s);
  return last < truth.count() && s[i].speed_m_s() < kStands_m_s &&
         std::any_of(s.begin() + i, s.begin() + last + 1,
                     [](const TruthSample& x) { return x.speed_m_s() > kWalks_m_s; });
}

std::vector<TruthEvent> turns_of(const Truth& truth) {
  constexpr double kRate_rad_s = 0.4, kPause_s = 0.3;
  const auto& s = truth.samples;
  std::vector<TruthEvent> turns;
  for (int i = 1; i < truth.count(); ++i) {
    if (s[i - 1].speed_m_s() <= kWalking_m_s || s[i].speed_m_s() <= kWalking_m_s) continue;
    const double change = heading_change(s[i - 1], s[i]), now_s = i * truth.step_s;
    if (std::abs(change) < kRate_rad_s * truth.step_s) continue;
    const Intention kind = side_of(change);
    const bool goes_on =
        !turns.empty() && turns.back().kind == kind && now_s - turns.back().end_s < kPause_s;
    if (!goes_on) turns.push_back({.kind = kind, .begin_s = now_s - truth.step_s});
    turns.back().end_s = now_s;
    turns.back().turn_rad += change;
  }
  std::erase_if(turns, [](const TruthEvent& e) { return std::abs(e.turn_rad) < kTurned_rad; });
  return turns;
}

std::vector<TruthEvent> stops_of(const Truth& truth) {
  constexpr double kBraking_m_s2 = 0.5;
  const auto& s = truth.samples;
  const auto brakes = [&](int k) {
    return s[k - 1].speed_m_s() - s[k].speed_m_s() > kBraking_m_s2 * truth.step_s;
  };
  std::vector<TruthEvent> stops;
  for (int i = 1; i < truth.count();) {
    int end = i;
    while (end < truth.count() && brakes(end)) ++end;
    const double before_m_s = s[i - 1].speed_m_s();
    if (end > i && before_m_s > kWalking_m_s && s[end - 1].speed_m_s() < 0.5 * before_m_s)
      stops.push_back({Intention::kDecelerate, (i - 1) * truth.step_s, (end - 1) * truth.step_s});
    i = end + 1;
  }
  return stops;
}

std::vector<TruthEvent> turns_and_stops_of(const Truth& truth) {
  std::vector<TruthEvent> events = turns_of(truth);
  const std::vector<TruthEvent> stops = stops_of(truth);
  events.insert(events.end(), stops.begin(), stops.end());
  std::stable_sort(events.begin(), events.end(),
                   [](const TruthEvent& a, const TruthEvent& b) { return a.begin_s < b.begin_s; });
  return events;
}

std::vector<TruthEvent> intended_events_of(const Truth& truth) {
  std::vector<TruthEvent> events;
  double turned_back_s = -kTurnBackAhead_s;  // slowing down for it and turning are one
  for (TruthEvent event : turns_and_stops_of(truth)) {
    const auto label = label_at(truth, truth.steps(event.begin_s));
    if (label == Intention::kTurnBack) {
      if (event.begin_s - turned_back_s < kTurnBackAhead_s) continue;
      turned_back_s = event.begin_s;
      event.kind = Intention::kTurnBack;
    } else if (event.kind == Intention::kDecelerate && label != Intention::kDecelerate) {
      continue;
    }
    events.push_back(event);
  }
  return events;
}

bool goes_straight(const Truth& truth, int i) {
  if (!is_known(truth, i, 3.0)) return false;
  const auto& s = truth.samples;
  for (int j = i; j <= i + truth.steps(3.0); ++j) {
    if (s[j].speed_m_s() < 0.7 * s[i].speed_m_s()) return false;
    if (std::abs(heading_change(s[i], s[j])) > rad(15.0)) return false;
  }
  return true;
}

}  // namespace foretrack
