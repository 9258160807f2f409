// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/short_term_motion.hpp"

#include <algorithm>
#include <cmath>

#include "core/prediction/dot.hpp"

namespace foretrack {
namespace {

// Part of what was fitted, and no parameters therefore.
constexpr double kWalkingSpeed_m_s = 0.2;  // below it, a velocity has no heading
constexpr double kLatest_s = 0.1;          // age of the oldest measurements

// Nobody is so far from what a filter believes: past it, the network knows nothing.
constexpr double kMost_m = 0.5, kMost_m_s = 2.0;

Vec2 at_most(const Vec2& v, double length) {
  const double norm = v.norm();
  return norm > length ? Vec2(v * (length / norm)) : v;
}

PlanarState corrected(const PlanarState& state, const Vec2& position_error,
                      const Vec2& velocity_error, const Eigen::Rotation2Dd& to_world) {
  return {state.position_m + to_world * at_most(position_error, kMost_m),
          state.velocity_m_s + to_world * at_most(velocity_error, kMost_m_s)};
}

}  // namespace

ShortTermFeatures short_term_features(const MotionHistory& history, const TargetState& target,
                                      double chest_offset_rad) {
  const Vec2 position_m = target.position_enu_m.head<2>();
  const Vec2 velocity_m_s = target.velocity_enu_m_s.head<2>();
  const double speed = velocity_m_s.norm();
  ShortTermFeatures f;
  f.body_known = std::isfinite(target.body_yaw_rad);
  const bool by_chest = f.body_known && speed < kWalkingSpeed_m_s;
  const double chest_rad = target.body_yaw_rad - chest_offset_rad;
  f.heading_rad = by_chest ? chest_rad : yaw_of(velocity_m_s);
  const Eigen::Rotation2Dd to_heading(-f.heading_rad);
  auto even = f.even.begin();
  auto odd = f.odd.begin();
  const auto add_angle = [&](double angle_rad) {
    *even++ = speed * (1.0 - std::cos(angle_rad));
    *odd++ = speed * std::sin(angle_rad);
    *odd++ = angle_rad;
  };
  *even++ = 1.0;
  *even++ = speed;
  *even++ = std::clamp(target.stamp_s - target.last_measurement_s, 0.0, kLatest_s);
  add_angle(f.body_known ? wrap_angle(chest_rad - f.heading_rad) : 0.0);
  for (const double age_s : ShortTermFeatures::kAges_s) {
    const MotionHistory::Sample& then = history.before(target.stamp_s, age_s);
    const double elapsed_s = target.stamp_s - then.stamp_s;
    const Vec2 change_m_s = to_heading * (velocity_m_s - then.measured.velocity_m_s);
    const Vec2 off_m =
        to_heading * (position_m - then.measured.position_m - elapsed_s * velocity_m_s);
    const double swing_rad = wrap_angle(target.body_yaw_rad - then.body_yaw_rad);
    add_angle(std::isfinite(swing_rad) ? swing_rad : 0.0);
    *even++ = change_m_s.x();
    *even++ = off_m.x();
    *odd++ = change_m_s.y();
    *odd++ = off_m.y();
  }
  return f;
}

ShortTermErrors short_term_errors(const ShortTermFeatures& f, const ShortTermWeights& w) {
  std::array<double, ShortTermWeights::kHidden> sum{}, difference{};
  for (int j = 0; j < ShortTermWeights::kHidden; ++j) {
    const double even = dot(w.hidden_even[j], f.even), odd = dot(w.hidden_odd[j], f.odd);
    const double here = std::tanh(even + odd), mirrored = std::tanh(even - odd);
    sum[j] = here + mirrored;
    difference[j] = here - mirrored;
  }
  ShortTermErrors errors;
  for (int i = 0; i < ShortTermWeights::kOutputs; ++i)
    errors[i] = {dot(w.along_even[i], f.even) + dot(w.along_hidden[i], sum),
                 dot(w.across_odd[i], f.odd) + dot(w.across_hidden[i], difference)};
  return errors;
}

ShortTermMotion filtered_motion(const TargetState& target) {
  const PlanarState now{target.position_enu_m.head<2>(), target.velocity_enu_m_s.head<2>()};
  return {now, advance(MotionModel::constant_velocity(), now, ShortTermMotion::kSoon_s)};
}

ShortTermMotion short_term_motion(const MotionHistory& history, const TargetState& target,
                                  double chest_offset_rad) {
  const ShortTermFeatures f = short_term_features(history, target, chest_offset_rad);
  const ShortTermErrors errors = short_term_errors(f, short_term_weights(f.body_known));
  const Eigen::Rotation2Dd to_world(f.heading_rad);
  const auto [now, soon] = filtered_motion(target);
  return {corrected(now, errors[0], errors[1], to_world),
          corrected(soon, errors[2], errors[3], to_world)};
}

}  // namespace foretrack
