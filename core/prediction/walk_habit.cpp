// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/walk_habit.hpp"

#include <cmath>

#include "core/common/geometry.hpp"

namespace foretrack {
namespace {

constexpr double kLongestPause_s = 1.0;
constexpr double kMemory_s = 60.0;
constexpr double kTurn_rad = rad(30.0), kOver_rad = rad(12.0);
constexpr double kStands = 1.5, kWalks = 3.0;  // times the speed from which on it walks
// Before anything was seen: a turn in five seconds and a stop in forty, believed as if walked for
// so long.
constexpr double kPriorTurns = 1.0, kPriorWalked_s = 5.0;
constexpr double kTurnBack_rad = rad(120.0), kTurnBackOver_rad = rad(60.0);
constexpr double kPriorTurnBacks = 0.2;
constexpr double kPriorStops = 0.5, kPriorWalkedOn_s = 20.0;

}  // namespace

double WalkHabit::log_turn_rate() const {
  return std::log((turns + kPriorTurns) / (walked_s + kPriorWalked_s));
}

double WalkHabit::log_stop_rate() const {
  return std::log((stops + kPriorStops) / (walked_s + kPriorWalkedOn_s));
}

double WalkHabit::log_turn_back_rate() const {
  return std::log((turn_backs + kPriorTurnBacks) / (walked_s + kPriorWalkedOn_s));
}

void follow(WalkHabit& habit, const WalkMoment& now, double walking_speed_m_s) {
  const double dt_s = now.stamp_s - habit.stamp_s;
  if (dt_s < 0.0) habit = {};
  habit.stamp_s = now.stamp_s;
  if (dt_s < 0.0 || dt_s > kLongestPause_s) return;
  const double kept = std::exp(-dt_s / kMemory_s);
  if (!habit.standing && now.speed_m_s < kStands * walking_speed_m_s)
    habit.standing = true, habit.stops += 1.0;
  if (habit.standing && now.speed_m_s > kWalks * walking_speed_m_s) habit.standing = false;
  if (now.speed_m_s < walking_speed_m_s) return;
  habit.turns *= kept;
  habit.stops *= kept;
  habit.turn_backs *= kept;
  habit.walked_s = kept * habit.walked_s + dt_s;
  habit.straight_s += dt_s;
  const double turn_rad = std::abs(now.recent_turn_rad);
  if (!habit.turning && turn_rad > kTurn_rad) habit.turning = true, habit.turns += 1.0;
  if (habit.turning && turn_rad < kOver_rad) habit.turning = false;
  if (habit.turning) habit.straight_s = 0.0;
  if (!habit.turning_back && turn_rad > kTurnBack_rad)
    habit.turning_back = true, habit.turn_backs += 1.0;
  if (habit.turning_back && turn_rad < kTurnBackOver_rad) habit.turning_back = false;
}

}  // namespace foretrack
