#include "core/prediction/turn_habit.hpp"

#include <cmath>

#include "core/common/geometry.hpp"

namespace foretrack {
namespace {

constexpr double kLongestPause_s = 1.0;
constexpr double kMemory_s = 60.0;
constexpr double kTurn_rad = rad(30.0), kOver_rad = rad(12.0);
// Before anything was seen: a turn in five seconds, believed as if seen once.
constexpr double kPriorTurns = 1.0, kPriorWalked_s = 5.0;

}  // namespace

double TurnHabit::log_rate() const {
  return std::log((turns + kPriorTurns) / (walked_s + kPriorWalked_s));
}

void follow(TurnHabit& habit, double stamp_s, double recent_turn_rad, bool walking) {
  const double dt_s = stamp_s - habit.stamp_s;
  if (dt_s < 0.0) habit = {};
  habit.stamp_s = stamp_s;
  if (dt_s < 0.0 || dt_s > kLongestPause_s || !walking) return;
  const double kept = std::exp(-dt_s / kMemory_s);
  habit.turns *= kept;
  habit.walked_s = kept * habit.walked_s + dt_s;
  habit.straight_s += dt_s;
  const double turn_rad = std::abs(recent_turn_rad);
  if (!habit.turning && turn_rad > kTurn_rad) habit.turning = true, habit.turns += 1.0;
  if (habit.turning && turn_rad < kOver_rad) habit.turning = false;
  if (habit.turning) habit.straight_s = 0.0;
}

}  // namespace foretrack
