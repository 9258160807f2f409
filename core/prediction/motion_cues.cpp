// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/motion_cues.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace foretrack {
namespace {

constexpr double kRecent_s = 1.0;
constexpr double kSteady_s = 0.25;
constexpr double kTurnedRound_rad = rad(120.0);
constexpr double kManoeuvre_m_s = 0.5;  // of velocity between now and soon

double heading_change(const MotionHistory::Sample& from, const Vec2& to_m_s, double walking_m_s) {
  if (from.measured.velocity_m_s.norm() < walking_m_s || to_m_s.norm() < walking_m_s) return 0.0;
  return wrap_angle(yaw_of(to_m_s) - yaw_of(from.measured.velocity_m_s));
}

ShortTermMotion tell_motion(MotionMemory& memory, const TargetState& target,
                            const PlanarState& measured, const PredictionParams& params) {
  const MotionHistory& h = memory.history;
  follow(memory.chest, h, target);
  judge(memory.trust, target.stamp_s, measured);
  TargetState faceless = target;
  faceless.body_yaw_rad = std::numeric_limits<double>::quiet_NaN();
  const ByForecaster<ShortTermMotion> said = {
      short_term_motion(h, target, memory.chest.angle_rad()), short_term_motion(h, faceless),
      filtered_motion(target)};
  note(memory.trust, target.stamp_s, said);
  return params.short_term_network ? mixed(said, memory.trust) : filtered_motion(target);
}

void read_body(MotionHistory& h, const TargetState& target, const PredictionParams& params,
               MotionCues& cues) {
  const Vec2& velocity_m_s = cues.measured.velocity_m_s;
  if (cues.body_known && velocity_m_s.norm() >= params.walking_speed_m_s)
    cues.body_turn_rad = wrap_angle(cues.chest_rad - yaw_of(velocity_m_s));  // eq. 3
  h.samples[h.newest].body_turn_rad = cues.body_turn_rad;
  double sum = 0.0;
  int n = 0;
  for (; n < h.count && target.stamp_s - h.back(n).stamp_s <= kSteady_s; ++n)
    sum += h.back(n).body_turn_rad;
  cues.steady_body_turn_rad = n > 0 ? sum / n : 0.0;
}

void read_body_swing(const MotionHistory& h, const TargetState& target, MotionCues& cues) {
  for (std::size_t i = 0; i < cues.body_swing_rad.size() && cues.body_known; ++i) {
    const double yaw_then = h.before(target.stamp_s, MotionCues::kSwing_s[i]).body_yaw_rad;
    if (std::isfinite(yaw_then))
      cues.body_swing_rad[i] = wrap_angle(target.body_yaw_rad - yaw_then);
  }
}

// Of the velocity as it was measured.
void read_changes(const MotionHistory& h, const Vec2& velocity, double stamp_s,
                  const PredictionParams& params, MotionCues& cues) {
  const auto& before = h.before(stamp_s, params.speed_fall_interval_s);
  cues.speed_fall_m_s = before.measured.velocity_m_s.norm() - velocity.norm();
  for (std::size_t i = 0; i < cues.recent_fall_m_s.size(); ++i) {
    const auto& then = h.before(stamp_s, MotionCues::kFall_s[i]);
    cues.recent_fall_m_s[i] = then.measured.velocity_m_s.norm() - velocity.norm();
  }
  const double elapsed_s = stamp_s - before.stamp_s;
  if (elapsed_s > 0.5 * params.speed_fall_interval_s)
    cues.turn_rate_rad_s = heading_change(before, velocity, params.walking_speed_m_s) / elapsed_s;
  const auto& recent = h.before(stamp_s, kRecent_s);
  cues.recent_turn_rad = heading_change(recent, velocity, params.walking_speed_m_s);
}

// Who is about to turn back slows down first: the course is that of the time before.
Gait gait_of(const MotionHistory& h, const TargetState& target, const MotionCues& cues) {
  constexpr double kSlowed = 0.5;  // times the pace
  const PlanarState* fastest = &cues.state;
  for (int i = 0; i < h.count && target.stamp_s - h.back(i).stamp_s <= kRecent_s; ++i)
    if (h.back(i).measured.velocity_m_s.norm() > fastest->velocity_m_s.norm())
      fastest = &h.back(i).measured;
  Gait gait;
  gait.pace_m_s = fastest->velocity_m_s.norm();
  const bool slowed = cues.speed_m_s < kSlowed * gait.pace_m_s;
  const double course_rad = slowed ? yaw_of(fastest->velocity_m_s) : cues.heading_rad;
  gait.back_rad = wrap_angle(course_rad + kPi);
  const bool chest_turned =
      cues.body_known && std::abs(wrap_angle(cues.chest_rad - course_rad)) > kTurnedRound_rad;
  if (chest_turned && cues.chest_trust > 0.5) gait.back_rad = cues.chest_rad;
  return gait;
}

}  // namespace

MotionCues without_chest(MotionCues cues) {
  cues.body_known = false;
  cues.body_turn_rad = cues.steady_body_turn_rad = 0.0;
  cues.body_swing_rad = {};
  return cues;
}

MotionCues observe_motion(MotionMemory& memory, const TargetState& seen,
                          const PredictionParams& params) {
  MotionHistory& h = memory.history;
  TargetState target = seen;
  target.body_yaw_rad = unflipped_yaw_rad(memory.chest, seen);
  MotionCues cues;
  cues.measured = {target.position_enu_m.head<2>(), target.velocity_enu_m_s.head<2>()};
  cues.height_m = target.position_enu_m.z();
  cues.body_known = std::isfinite(target.body_yaw_rad);
  remember(h, {target.stamp_s, cues.measured, target.body_yaw_rad});
  const ShortTermMotion motion = tell_motion(memory, target, cues.measured, params);
  cues.chest_rad = wrap_angle(target.body_yaw_rad - memory.chest.angle_rad());
  cues.chest_trust = memory.trust.in_chest();
  cues.state = motion.now;
  cues.soon = motion.soon;
  const Vec2 change_m_s = motion.soon.velocity_m_s - motion.now.velocity_m_s;
  cues.manoeuvre = std::min(1.0, change_m_s.norm() / kManoeuvre_m_s);
  cues.speed_m_s = cues.state.velocity_m_s.norm();
  cues.walking = cues.speed_m_s >= params.walking_speed_m_s;
  cues.heading_rad =
      cues.walking || !cues.body_known ? yaw_of(cues.state.velocity_m_s) : cues.chest_rad;
  if (cues.walking) {
    const Eigen::Rotation2Dd to_heading(-cues.heading_rad);
    cues.soon_turn_rad = yaw_of(Vec2(to_heading * motion.soon.velocity_m_s));
    cues.soon_fall_m_s = cues.speed_m_s - motion.soon.velocity_m_s.norm();
  }
  read_body_swing(h, target, cues);
  read_body(h, target, params, cues);
  read_changes(h, cues.measured.velocity_m_s, target.stamp_s, params, cues);
  follow(memory.habit, {target.stamp_s, cues.recent_turn_rad, cues.speed_m_s},
         params.walking_speed_m_s);
  cues.log_turns_per_s = memory.habit.log_turn_rate();
  cues.log_stops_per_s = memory.habit.log_stop_rate();
  cues.straight_s = memory.habit.straight_s;
  cues.log_turn_backs_per_s = memory.habit.log_turn_back_rate();
  cues.gait = gait_of(h, target, cues);
  return cues;
}

}  // namespace foretrack
