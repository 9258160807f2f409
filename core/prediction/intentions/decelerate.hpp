// SPDX-License-Identifier: Apache-2.0
// To slow down and stop.
#pragma once

#include "core/prediction/intentions/feature_terms.hpp"

namespace foretrack::intentions {

inline constexpr int kDecelerateFeatures = 18;
/// Written by bench/prediction's fit_intention.
LogitView decelerate_weights(bool map_known, bool body_known);
inline constexpr IntentionHead kDecelerateHead{"decelerate", kDecelerateFeatures,
                                               decelerate_weights};

inline void add_fall_of_speed(FeatureVector& out, const MotionCues& motion) {
  // The share of the speed that is lost; for a corner too, but there the chest turns.
  const double swing = std::abs(motion.body_swing_rad.back());
  const double straight = std::exp(-square(swing / 0.35));
  const double speed = motion.measured.velocity_m_s.norm();
  double lost = 0.0;
  for (const double fall_m_s : motion.recent_fall_m_s) {
    lost = std::clamp(fall_m_s / std::max(speed + fall_m_s, 0.3), -1.0, 1.0);
    out.add(2.0 * lost);
  }
  out.add(5.0 * straight * positive(lost));
  out.add(5.0 * straight * square(positive(lost)));
  out.add(std::min(swing, 1.5));
}

inline void write_decelerate(const FeatureInputs& in, FeatureVector& out) {
  const MotionCues& motion = in.evidence.motion;
  const Surroundings& surroundings = in.evidence.surroundings;
  out.add(1.0);
  out.add(motion.speed_m_s);
  out.add(std::clamp(motion.speed_fall_m_s, -1.0, 1.0));
  out.add(std::clamp(in.own.observation, 0.0, 3.0));
  out.add(std::abs(std::clamp(motion.turn_rate_rad_s, -3.0, 3.0)));
  out.add(std::abs(std::clamp(motion.steady_body_turn_rad, -1.2, 1.2)));
  add_fall_of_speed(out, motion);
  out.add(std::clamp(motion.soon_fall_m_s, -1.0, 1.0));
  out.add(motion.log_stops_per_s);
  out.add(motion.log_turns_per_s);
  if (!in.map_known) return;
  const double obstacle_s = time_to_obstacle_s(motion, surroundings);
  out.add(std::clamp(in.own.potential, 0.0, 3.0));
  out.add(std::exp(-obstacle_s / 0.4));
  out.add(std::exp(-obstacle_s));
  const double widest_m =
      std::max(last_width_m(surroundings.left_width_m), last_width_m(surroundings.right_width_m));
  out.add(std::exp(-obstacle_s) * widest_m / Surroundings::kSideRange_m);
}

inline constexpr IntentionRow kDecelerate{
    .name = "decelerate",
    .color_rgb = 0xd98cbb,
    .margin = Margin::kDistance,
    .potential =
        [](const IntentionEvidence& e) {
          // eq. 8, with a floor under d_obs, and nothing when no obstacle is in range.
          const double distance_m = e.surroundings.obstacle_distance_m;
          if (distance_m >= e.params.obstacle_range_m) return 0.0;
          const double speed = e.motion.speed_m_s;
          return e.params.k3_decelerate_potential * speed * speed /
                 std::max(distance_m, e.params.obstacle_floor_m);
        },
    .observation =
        [](const IntentionEvidence& e) {  // eq. 9
          return std::max(e.params.k4_decelerate_observation * e.motion.speed_fall_m_s, 0.0);
        },
    .motion_model =
        [](const PredictionParams& p) { return MotionModel::deceleration(p.deceleration_m_s2); },
    .costs = {.begin = 1.5, .end = 1.0, .change = 1.0},
    .noise_m2_s3 = 0.2,
    .head = &kDecelerateHead,
    .features = write_decelerate,
};

}  // namespace foretrack::intentions
