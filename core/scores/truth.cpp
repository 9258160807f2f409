// SPDX-License-Identifier: Apache-2.0
#include "core/scores/truth.hpp"

#include <algorithm>

namespace foretrack {
namespace {

constexpr double kWalking_m_s = 0.3;
constexpr double kTurn_rad = rad(30.0);
constexpr double kOnset_rad = rad(5.0);
constexpr double kOnsetShare = 0.95;  // of the speed before a stop
constexpr double kRest_s = 0.1;       // a turn is over when the heading rests for so long

double heading_change(const TruthSample& from, const TruthSample& to) {
  return wrap_angle(yaw_of(to.velocity_m_s) - yaw_of(from.velocity_m_s));
}

bool is_known(const Truth& truth, int i, double ahead_s) {
  return i + truth.steps(ahead_s) < truth.count() && truth.samples[i].speed_m_s() > kWalking_m_s;
}

// Index of the first sample within a second whose heading differs by 30°; −1: none.
int turn_after(const Truth& truth, int i) {
  const auto& s = truth.samples;
  for (int j = i + 1; j <= i + truth.steps(1.0); ++j)
    if (s[j].speed_m_s() > kWalking_m_s && std::abs(heading_change(s[i], s[j])) > kTurn_rad)
      return j;
  return -1;
}

// The same for a speed that halves.
int stop_after(const Truth& truth, int i) {
  const auto& s = truth.samples;
  for (int j = i + 1; j <= i + truth.steps(1.0); ++j)
    if (s[j].speed_m_s() < 0.5 * s[i].speed_m_s()) return j;
  return -1;
}

Intention side_of(double turn_rad) {
  return turn_rad > 0.0 ? Intention::kTurnLeft : Intention::kTurnRight;
}

}  // namespace

std::optional<Intention> label_at(const Truth& truth, int i) {
  if (!is_known(truth, i, 1.0)) return std::nullopt;
  const auto& s = truth.samples;
  if (const int j = turn_after(truth, i); j >= 0) return side_of(heading_change(s[i], s[j]));
  const int slow = stop_after(truth, i);
  if (slow < 0) return Intention::kForward;
  if (!is_known(truth, slow, 1.0)) return Intention::kDecelerate;
  const int turned = turn_after(truth, slow);  // slow because of a turn
  return turned < 0 ? Intention::kDecelerate : side_of(heading_change(s[i], s[turned]));
}

std::vector<TruthEvent> turns_of(const Truth& truth) {
  const auto& s = truth.samples;
  const int rest = truth.steps(kRest_s);
  std::vector<TruthEvent> turns;
  for (int i = 0; i < truth.count(); ++i) {
    if (!is_known(truth, i, 1.0)) continue;
    const int turned = turn_after(truth, i);
    if (turned < 0) continue;
    int onset = turned;
    while (onset > i && std::abs(heading_change(s[i], s[onset])) > kOnset_rad) --onset;
    turns.push_back({side_of(heading_change(s[i], s[turned])), onset * truth.step_s});
    // The same turn goes on until the heading rests.
    i = turned;
    while (i + rest < truth.count() && std::abs(heading_change(s[i], s[i + rest])) > kOnset_rad)
      ++i;
  }
  return turns;
}

std::vector<TruthEvent> stops_of(const Truth& truth) {
  const auto& s = truth.samples;
  std::vector<TruthEvent> stops;
  for (int i = 0; i < truth.count(); ++i) {
    if (label_at(truth, i) != Intention::kDecelerate) continue;
    const int slow = stop_after(truth, i);
    int onset = slow;
    while (onset > i && s[onset].speed_m_s() < kOnsetShare * s[i].speed_m_s()) --onset;
    stops.push_back({Intention::kDecelerate, onset * truth.step_s});
    const double before_m_s = s[i].speed_m_s();
    i = slow;
    while (i + 1 < truth.count() && s[i].speed_m_s() < 0.5 * before_m_s) ++i;
  }
  return stops;
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
