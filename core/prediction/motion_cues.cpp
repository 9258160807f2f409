#include "core/prediction/motion_cues.hpp"

#include <cmath>

namespace foretrack {
namespace {

constexpr double kThinning_s = 0.018;
constexpr double kLongestGap_s = 1.0;
constexpr double kRecent_s = 1.0;
constexpr double kSteady_s = 0.25;

void remember(MotionHistory& h, const MotionHistory::Sample& sample) {
  if (h.count > 0) {
    const double gap_s = sample.stamp_s - h.back(0).stamp_s;
    if (gap_s < 0.0 || gap_s > kLongestGap_s)
      h.count = 0;
    else if (gap_s < kThinning_s)
      return;
  }
  h.newest = (h.newest + 1) % MotionHistory::kCapacity;
  h.samples[h.newest] = sample;
  h.count = std::min(h.count + 1, MotionHistory::kCapacity);
}

// The youngest sample that is at least this old, or else the oldest.
const MotionHistory::Sample& sample_before(const MotionHistory& h, double stamp_s, double age_s) {
  for (int i = 0; i < h.count; ++i)
    if (stamp_s - h.back(i).stamp_s >= age_s - 1e-6) return h.back(i);
  return h.back(h.count - 1);
}

double heading_change(const MotionHistory::Sample& from, const Vec2& to_m_s, double walking_m_s) {
  if (from.velocity_m_s.norm() < walking_m_s || to_m_s.norm() < walking_m_s) return 0.0;
  return wrap_angle(yaw_of(to_m_s) - yaw_of(from.velocity_m_s));
}

// Change of the velocity in a second, less what noise may be.
Vec2 acceleration_m_s2(const MotionHistory& h, double stamp_s, const Vec2& velocity_m_s,
                       const PredictionParams& params) {
  const auto& before = sample_before(h, stamp_s, params.acceleration_interval_s);
  const double elapsed_s = stamp_s - before.stamp_s;
  const Vec2 change_m_s = velocity_m_s - before.velocity_m_s;
  const double size_m_s = change_m_s.norm();
  if (elapsed_s < 0.5 * params.acceleration_interval_s || size_m_s <= params.velocity_noise_m_s)
    return Vec2::Zero();
  return change_m_s * ((1.0 - params.velocity_noise_m_s / size_m_s) / elapsed_s);
}

void read_body(MotionHistory& h, const TargetState& target, MotionCues& cues) {
  if (cues.walking && cues.body_known)
    cues.body_turn_rad = wrap_angle(target.body_yaw_rad - cues.heading_rad);  // eq. 3
  h.samples[h.newest].body_turn_rad = cues.body_turn_rad;
  double sum = 0.0;
  int n = 0;
  for (; n < h.count && target.stamp_s - h.back(n).stamp_s <= kSteady_s; ++n)
    sum += h.back(n).body_turn_rad;
  cues.steady_body_turn_rad = n > 0 ? sum / n : 0.0;
}

void read_body_swing(const MotionHistory& h, const TargetState& target, MotionCues& cues) {
  for (std::size_t i = 0; i < cues.body_swing_rad.size() && cues.body_known; ++i) {
    const double yaw_then = sample_before(h, target.stamp_s, MotionCues::kSwing_s[i]).body_yaw_rad;
    if (std::isfinite(yaw_then))
      cues.body_swing_rad[i] = wrap_angle(target.body_yaw_rad - yaw_then);
  }
}

// Of the velocity as it was measured: a smoothed one would tell late.
void read_changes(const MotionHistory& h, const Vec2& velocity, double stamp_s,
                  const PredictionParams& params, MotionCues& cues) {
  const auto& before = sample_before(h, stamp_s, params.speed_fall_interval_s);
  cues.speed_fall_m_s = before.velocity_m_s.norm() - velocity.norm();
  for (std::size_t i = 0; i < cues.recent_fall_m_s.size(); ++i) {
    const auto& then = sample_before(h, stamp_s, MotionCues::kFall_s[i]);
    cues.recent_fall_m_s[i] = then.velocity_m_s.norm() - velocity.norm();
  }
  const double elapsed_s = stamp_s - before.stamp_s;
  if (elapsed_s > 0.5 * params.speed_fall_interval_s)
    cues.turn_rate_rad_s = heading_change(before, velocity, params.walking_speed_m_s) / elapsed_s;
  cues.acceleration_m_s2 = acceleration_m_s2(h, stamp_s, velocity, params);
  const auto& recent = sample_before(h, stamp_s, kRecent_s);
  cues.recent_turn_rad = heading_change(recent, velocity, params.walking_speed_m_s);
}

}  // namespace

MotionCues observe_motion(MotionHistory& h, const TargetState& target,
                          const PredictionParams& params) {
  MotionCues cues;
  const PlanarState measured{target.position_enu_m.head<2>(), target.velocity_enu_m_s.head<2>()};
  cues.height_m = target.position_enu_m.z();
  cues.body_known = std::isfinite(target.body_yaw_rad);
  remember(h, {target.stamp_s, measured.velocity_m_s, 0.0, target.body_yaw_rad});
  read_body_swing(h, target, cues);
  follow(h.walk, measured, target.stamp_s, cues.body_swing_rad[MotionCues::kTellingSwing], params);
  cues.measured = measured;
  cues.state = h.walk.state(measured);
  cues.manoeuvre = h.walk.manoeuvre;
  cues.speed_m_s = cues.state.velocity_m_s.norm();
  cues.walking = cues.speed_m_s >= params.walking_speed_m_s;
  const double velocity_yaw = cues.speed_m_s > 0.0 ? yaw_of(cues.state.velocity_m_s) : 0.0;
  cues.heading_rad = cues.walking || !cues.body_known ? velocity_yaw : target.body_yaw_rad;
  read_body(h, target, cues);
  read_changes(h, measured.velocity_m_s, target.stamp_s, params, cues);
  follow(h.habit, target.stamp_s, cues.recent_turn_rad, cues.walking);
  cues.log_turns_per_s = h.habit.log_rate();
  cues.straight_s = h.habit.straight_s;
  return cues;
}

}  // namespace foretrack
