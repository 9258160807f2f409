// SPDX-License-Identifier: Apache-2.0
// To turn left or right: one is the other's mirror image, and both share one fitted head.
#pragma once

#include "core/prediction/intentions/feature_terms.hpp"

namespace foretrack::intentions {

inline constexpr int kTurnFeatures = 56;
/// Written by bench/prediction's fit_intention.
LogitView turn_weights(bool map_known, bool body_known);
inline constexpr IntentionHead kTurnHead{"turn", kTurnFeatures, turn_weights};

/// One side of a target that may turn to it.
struct TurnSide {
  double sign;  // +1 left, −1 right
  double half_angle_rad, half_angle_ahead_rad;
  const std::array<double, Surroundings::kSideCount>& width_m;

  TurnSide(double side, const Surroundings& s)
      : sign(side),
        half_angle_rad(side > 0.0 ? s.region.left_half_angle_rad : s.region.right_half_angle_rad),
        half_angle_ahead_rad(side > 0.0 ? s.region_ahead.left_half_angle_rad
                                        : s.region_ahead.right_half_angle_rad),
        width_m(side > 0.0 ? s.left_width_m : s.right_width_m) {}

  double potential(const PredictionParams& p) const {  // eq. 6
    return std::max(p.k1_turn_potential * (half_angle_ahead_rad - half_angle_rad), 0.0);
  }
};

inline void add_turn_motion(FeatureVector& out, double sign, double observation,
                            const MotionCues& motion) {
  out.add(1.0);
  out.add(sign * std::clamp(motion.turn_rate_rad_s, -3.0, 3.0));
  out.add(positive(sign * motion.recent_turn_rad));
  out.add(positive(-sign * motion.recent_turn_rad));
  out.add(motion.speed_m_s);
  out.add(std::clamp(motion.speed_fall_m_s, -1.0, 1.0));
  const double body = sign * std::clamp(motion.steady_body_turn_rad, -1.2, 1.2);
  out.add(body);
  out.add(positive(body) * positive(body));
  out.add(std::min(observation, 3.0));
  for (const double swing_rad : motion.body_swing_rad)
    out.add(sign * std::clamp(swing_rad, -1.2, 1.2));
  const double begun = positive(sign * motion.body_swing_rad[MotionCues::kTellingSwing]);
  out.add(std::min(begun * begun, 1.5));
  // How far the chest has left the course, and how much of a turn shows already.
  const double left_rad = sign * std::clamp(motion.body_turn_rad, -1.2, 1.2);
  out.add(left_rad);
  out.add(sign * std::clamp(motion.soon_turn_rad, -1.2, 1.2));
  out.add(motion.manoeuvre);
  out.add(std::clamp(motion.recent_fall_m_s[0], -1.0, 1.0));
  out.add(motion.log_turns_per_s);
  out.add(std::exp(-motion.straight_s / 3.0));
}

/// soon: nearness of an obstacle ahead.
inline void add_turn_side(FeatureVector& out, const TurnSide& side, const PredictionParams& params,
                          double soon) {
  out.add(side.potential(params));
  out.add(side.half_angle_rad);
  out.add(side.half_angle_ahead_rad);
  out.add(soon * last_width_m(side.width_m) / Surroundings::kSideRange_m);
  const double hugging = std::exp(-side.width_m[0] / 0.7);
  out.add(hugging);
  // Where along the way the side opens, and whether the target keeps to that side.
  double widest_m = side.width_m[0];
  for (int i = 1; i < Surroundings::kSideCount; ++i) {
    const double opening = std::min(1.0, positive(side.width_m[i] - widest_m));
    widest_m = std::max(widest_m, side.width_m[i]);
    out.add(opening);
    out.add(opening * hugging);
  }
}

template <int kSign>
void write_turn(const FeatureInputs& in, FeatureVector& out) {
  const MotionCues& motion = in.evidence.motion;
  const Surroundings& surroundings = in.evidence.surroundings;
  const TurnSide side(kSign, surroundings), other(-kSign, surroundings);
  add_turn_motion(out, kSign, in.own.observation, motion);
  if (!in.map_known) return;
  const double obstacle_s = time_to_obstacle_s(motion, surroundings);
  const double soon = std::exp(-obstacle_s / 1.5);
  out.add(soon);
  out.add(std::exp(-obstacle_s / 0.5));
  out.add(soon * positive(last_width_m(side.width_m) - last_width_m(other.width_m)) /
          Surroundings::kSideRange_m);
  add_turn_side(out, side, in.evidence.params, soon);
  add_turn_side(out, other, in.evidence.params, soon);
}

/// kSign: +1 left, −1 right.
template <int kSign>
constexpr IntentionRow turn_row(std::string_view name, std::uint32_t color_rgb) {
  return {
      .name = name,
      .color_rgb = color_rgb,
      .margin = kSign > 0 ? Margin::kLeft : Margin::kRight,
      .potential =
          [](const IntentionEvidence& e) {
            return TurnSide(kSign, e.surroundings).potential(e.params);
          },
      .observation =
          [](const IntentionEvidence& e) {  // eq. 7
            return std::max(kSign * e.params.k2_turn_observation * e.motion.body_turn_rad, 0.0);
          },
      .motion_model =
          [](const PredictionParams& p) { return MotionModel::turn(kSign * p.turn_rate_rad_s); },
      .costs = {.begin = 1.0, .end = 0.3, .change = 1.0, .mirrored = 3.0},
      .noise_m2_s3 = 0.2,
      .head = &kTurnHead,
      .features = write_turn<kSign>,
  };
}

inline constexpr IntentionRow kTurnLeft = turn_row<1>("turn_left", 0xe69f00);
inline constexpr IntentionRow kTurnRight = turn_row<-1>("turn_right", 0x2fc79b);

}  // namespace foretrack::intentions
