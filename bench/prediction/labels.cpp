#include "bench/prediction/labels.hpp"

#include <algorithm>

namespace foretrack::bench {
namespace {

constexpr double kWalking_m_s = 0.3;
constexpr double kTurn_rad = rad(30.0);
constexpr double kOnset_rad = rad(5.0);
constexpr int kSecond = static_cast<int>(1.0 / kTruthStep_s + 0.5);

double heading_change(const TruthSample& from, const TruthSample& to) {
  return wrap_angle(yaw_of(to.velocity_m_s) - yaw_of(from.velocity_m_s));
}

// Index of the first sample within a second whose heading differs by 30°; −1: none.
int turn_after(const std::vector<TruthSample>& truth, int i) {
  for (int j = i + 1; j <= i + kSecond; ++j)
    if (truth[j].speed_m_s() > kWalking_m_s &&
        std::abs(heading_change(truth[i], truth[j])) > kTurn_rad)
      return j;
  return -1;
}

bool is_known(const std::vector<TruthSample>& truth, int i, int ahead) {
  return i + ahead < static_cast<int>(truth.size()) && truth[i].speed_m_s() > kWalking_m_s;
}

Intention side_of(double turn_rad) {
  return turn_rad > 0.0 ? Intention::kTurnLeft : Intention::kTurnRight;
}

}  // namespace

std::optional<Intention> label_at(const std::vector<TruthSample>& truth, int i) {
  if (!is_known(truth, i, kSecond)) return std::nullopt;
  if (const int j = turn_after(truth, i); j >= 0)
    return side_of(heading_change(truth[i], truth[j]));
  double slowest_m_s = truth[i].speed_m_s();
  for (int j = i; j <= i + kSecond; ++j) slowest_m_s = std::min(slowest_m_s, truth[j].speed_m_s());
  return slowest_m_s < 0.5 * truth[i].speed_m_s() ? Intention::kDecelerate : Intention::kForward;
}

std::vector<TurnEvent> turn_events(const std::vector<TruthSample>& truth) {
  std::vector<TurnEvent> events;
  for (int i = 0; i < static_cast<int>(truth.size()); ++i) {
    if (!is_known(truth, i, kSecond)) continue;
    const int turned = turn_after(truth, i);
    if (turned < 0) continue;
    int onset = turned;
    while (onset > i && std::abs(heading_change(truth[i], truth[onset])) > kOnset_rad) --onset;
    events.push_back({side_of(heading_change(truth[i], truth[turned])), onset});
    // The same turn goes on until the heading rests.
    i = turned;
    while (i + 5 < static_cast<int>(truth.size()) &&
           std::abs(heading_change(truth[i], truth[i + 5])) > kOnset_rad)
      ++i;
  }
  return events;
}

bool goes_straight(const std::vector<TruthSample>& truth, int i) {
  if (!is_known(truth, i, 3 * kSecond)) return false;
  for (int j = i; j <= i + 3 * kSecond; ++j) {
    if (truth[j].speed_m_s() < 0.7 * truth[i].speed_m_s()) return false;
    if (std::abs(heading_change(truth[i], truth[j])) > rad(15.0)) return false;
  }
  return true;
}

}  // namespace foretrack::bench
