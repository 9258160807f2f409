// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/chest_offset.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack {
namespace {

constexpr double kOffsetMemory_s = 4.0;
constexpr double kLongestSilence_s = 0.2;
constexpr double kJump_rad = 2.0;  // from one measurement to the next: nobody turns so fast
constexpr double kWalking_m_s = 0.4;
constexpr double kChestAge_s = 0.4;    // a chest's lead, and a filter's lag
constexpr double kStraight_rad = 0.3;  // of the course since then; more hardly counts
constexpr double kNoise_rad =
    rad(10.0);  // so much the measurements of a chest make up; twice it they do not
constexpr double kStraightAhead_s = 0.05;  // as believed before anything was seen

}  // namespace

double ChestOffset::angle_rad() const {
  const double angle_rad = std::atan2(mean_s.y(), mean_s.x() + kStraightAhead_s);
  return angle_rad * std::clamp(std::abs(angle_rad) / kNoise_rad - 1.0, 0.0, 1.0);
}

double unflipped_yaw_rad(ChestOffset& offset, const TargetState& target) {
  const double yaw_rad = target.body_yaw_rad;
  if (!std::isfinite(yaw_rad)) return yaw_rad;
  const double unseen_s = target.last_measurement_s - offset.seen_s;
  const bool jumped = std::abs(wrap_angle(yaw_rad - offset.yaw_rad)) > kJump_rad;
  if (jumped && unseen_s >= 0.0 && unseen_s < kLongestSilence_s) offset.flipped = !offset.flipped;
  offset.yaw_rad = yaw_rad;
  offset.seen_s = target.last_measurement_s;
  return offset.flipped ? wrap_angle(yaw_rad + kPi) : yaw_rad;
}

void follow(ChestOffset& offset, const MotionHistory& history, const TargetState& target) {
  const double dt_s = target.stamp_s - offset.stamp_s;
  offset.stamp_s = target.stamp_s;
  if (dt_s < 0.0 || history.count == 0) return;
  const MotionHistory::Sample& then = history.before(target.stamp_s, kChestAge_s);
  const Vec2 now_m_s = target.velocity_enu_m_s.head<2>();
  const bool walked =
      now_m_s.norm() > kWalking_m_s && then.measured.velocity_m_s.norm() > kWalking_m_s;
  const bool known_then = target.stamp_s - then.stamp_s > 0.5 * kChestAge_s;
  if (!walked || !known_then || !std::isfinite(then.body_yaw_rad)) return;
  const double course_rad = yaw_of(now_m_s);
  const double turned_rad = wrap_angle(course_rad - yaw_of(then.measured.velocity_m_s));
  const double seen_s = std::min(dt_s, kLongestSilence_s);
  const double weight = std::exp(-turned_rad * turned_rad / (kStraight_rad * kStraight_rad));
  offset.mean_s *= std::exp(-weight * seen_s / kOffsetMemory_s);
  offset.mean_s += weight * seen_s * direction_of(wrap_angle(then.body_yaw_rad - course_rad));
}

}  // namespace foretrack
