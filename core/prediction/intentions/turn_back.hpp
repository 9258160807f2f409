// SPDX-License-Identifier: Apache-2.0
// To turn round and walk back: at a dead end, for something forgotten, or for no reason that shows.
#pragma once

#include "core/prediction/intentions/feature_terms.hpp"

namespace foretrack::intentions {

inline constexpr int kTurnBackFeatures = 34;
/// Written by bench/prediction's fit_intention.
LogitView turn_back_weights(bool map_known, bool body_known);
inline constexpr IntentionHead kTurnBackHead{"turn_back", kTurnBackFeatures, turn_back_weights};

inline constexpr double kTurnBack_m_s2 = 2.5;         // of the change of velocity
inline constexpr double kSlowestBack_m_s = 0.5;       // who turns back walks
inline constexpr double kChestAside_rad = kPi / 2.0;  // further than for a corner

/// How closed the way ahead is to both sides, in [0, 1].
inline double closed_ahead(const ReachableRegion& ahead) {
  const double widest = std::max(ahead.left_half_angle_rad, ahead.right_half_angle_rad);
  return 1.0 - std::min(1.0, widest / (kPi / 4.0));
}

/// Features of how the target moves and turns. Neither side counts more than the other: whichever
/// way round the chest turns.
inline void add_turn_back_motion(FeatureVector& out, const FeatureInputs& in) {
  const MotionCues& motion = in.evidence.motion;
  const double body = std::abs(motion.body_turn_rad),
               steady = std::abs(motion.steady_body_turn_rad);
  const double soon = std::abs(motion.soon_turn_rad), recent = std::abs(motion.recent_turn_rad);
  out.add(1.0);
  out.add(motion.speed_m_s);
  out.add(std::clamp(motion.speed_fall_m_s, -2.0, 2.0));
  out.add(std::abs(std::clamp(motion.turn_rate_rad_s, -6.0, 6.0)));
  out.add(recent);
  out.add(positive(recent - kChestAside_rad));
  out.add(body);
  out.add(positive(body - 0.5 * kChestAside_rad));
  out.add(positive(body - kChestAside_rad));
  out.add(steady);
  out.add(positive(steady - 0.5 * kChestAside_rad));
  for (const double swing_rad : motion.body_swing_rad) {
    out.add(std::abs(swing_rad));
    out.add(positive(std::abs(swing_rad) - 0.8));
  }
  out.add(positive(std::abs(motion.body_swing_rad.back()) - kChestAside_rad));
  out.add(soon);
  out.add(positive(soon - 1.0));
  out.add(motion.manoeuvre);
}

/// Features of how fast the target is and was, and of what it did before.
inline void add_turn_back_pace(FeatureVector& out, const MotionCues& motion) {
  const double swing = std::abs(motion.body_swing_rad.back());
  const double speed = motion.measured.velocity_m_s.norm();
  for (const double fall_m_s : motion.recent_fall_m_s) {
    const double lost = std::clamp(fall_m_s / std::max(speed + fall_m_s, 0.3), -1.0, 1.0);
    out.add(2.0 * lost);
    out.add(positive(lost) * swing);
  }
  out.add(motion.speed_m_s / std::max(motion.gait.pace_m_s, 0.3));
  out.add(std::clamp(motion.soon_fall_m_s, -1.0, 1.0));
  out.add(motion.log_turns_per_s);
  out.add(motion.log_stops_per_s);
  out.add(motion.log_turn_backs_per_s);
  out.add(std::exp(-motion.straight_s / 3.0));
}

/// The features of turning back.
inline void write_turn_back(const FeatureInputs& in, FeatureVector& out) {
  const MotionCues& motion = in.evidence.motion;
  const Surroundings& surroundings = in.evidence.surroundings;
  add_turn_back_motion(out, in);
  add_turn_back_pace(out, motion);
  if (!in.map_known) return;
  const double soon = std::exp(-time_to_obstacle_s(motion, surroundings) / 1.5);
  const double widest_m =
      std::max(last_width_m(surroundings.left_width_m), last_width_m(surroundings.right_width_m));
  out.add(soon);
  out.add(soon * widest_m / Surroundings::kSideRange_m);
  out.add(soon * closed_ahead(surroundings.region_ahead));
}

inline constexpr IntentionRow kTurnBack{
    .name = "turn_back",
    .color_rgb = 0xff6b3d,
    .margin = Margin::kDistance,  // they come nearer
    .potential =
        [](const IntentionEvidence& e) {  // a dead end: as eq. 8, where both sides are closed
          const double distance_m = e.surroundings.obstacle_distance_m;
          if (distance_m >= e.params.obstacle_range_m) return 0.0;
          const double speed = e.motion.speed_m_s;
          return closed_ahead(e.surroundings.region_ahead) * e.params.k3_decelerate_potential *
                 speed * speed / std::max(distance_m, e.params.obstacle_floor_m);
        },
    .observation =
        [](const IntentionEvidence& e) {  // as eq. 7, of a chest that is turned too far for a turn
          return e.params.k2_turn_observation *
                 positive(std::abs(e.motion.body_turn_rad) - kChestAside_rad);
        },
    .motion_model =
        [](const PredictionParams&, const Gait& gait) {
          const double speed = std::max(gait.pace_m_s, kSlowestBack_m_s);
          return MotionModel::reversal(kTurnBack_m_s2, speed * direction_of(gait.back_rad));
        },
    .costs = {.begin = 2.0, .end = 0.3, .change = 2.0},
    .may_follow = false,
    .noise_m2_s3 = 0.3,
    .head = &kTurnBackHead,
    .features = write_turn_back,
};

}  // namespace foretrack::intentions
