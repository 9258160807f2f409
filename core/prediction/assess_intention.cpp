// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/assess_intention.hpp"

#include <algorithm>

namespace foretrack {
namespace {

using Evidence = IntentionEvidence;
using Params = PredictionParams;

double turn_left_potential(const Evidence& e, const Params& p) {  // eq. 6
  const auto& s = e.surroundings;
  const double opening = s.region_ahead.left_half_angle_rad - s.region.left_half_angle_rad;
  return std::max(p.k1_turn_potential * opening, 0.0);
}
double turn_right_potential(const Evidence& e, const Params& p) {
  const auto& s = e.surroundings;
  const double opening = s.region_ahead.right_half_angle_rad - s.region.right_half_angle_rad;
  return std::max(p.k1_turn_potential * opening, 0.0);
}
double turn_left_observation(const Evidence& e, const Params& p) {  // eq. 7
  return std::max(p.k2_turn_observation * e.motion.body_turn_rad, 0.0);
}
double turn_right_observation(const Evidence& e, const Params& p) {
  return std::max(-p.k2_turn_observation * e.motion.body_turn_rad, 0.0);
}

// eq. 8, with a floor under d_obs, and nothing when no obstacle is in range.
double decelerate_potential(const Evidence& e, const Params& p) {
  const double distance_m = e.surroundings.obstacle_distance_m;
  if (distance_m >= p.obstacle_range_m) return 0.0;
  const double speed = e.motion.speed_m_s;
  return p.k3_decelerate_potential * speed * speed / std::max(distance_m, p.obstacle_floor_m);
}
double decelerate_observation(const Evidence& e, const Params& p) {  // eq. 9
  return std::max(p.k4_decelerate_observation * e.motion.speed_fall_m_s, 0.0);
}

double forward_potential(const Evidence& e, const Params& p) {  // eq. 10
  return -p.k4_forward_potential * e.strongest_potential + p.b1_forward_potential;
}
double forward_observation(const Evidence& e, const Params& p) {
  return -p.k5_forward_observation * e.strongest_observation + p.b2_forward_observation;
}

MotionModel go_on(const Params&) {
  return MotionModel::constant_velocity();
}
MotionModel turn_left(const Params& p) {
  return MotionModel::turn(p.turn_rate_rad_s);
}
MotionModel turn_right(const Params& p) {
  return MotionModel::turn(-p.turn_rate_rad_s);
}
MotionModel slow_down(const Params& p) {
  return MotionModel::deceleration(p.deceleration_m_s2);
}

void score(const IntentionRow& row, const Evidence& evidence, const Params& params,
           IntentionAssessment& assessment) {
  IntentionBelief& belief = assessment[row.intention];
  belief.potential = row.potential(evidence, params);
  belief.observation = row.observation(evidence, params);
  const double sum = belief.potential + belief.observation;
  belief.score = 0.5 * (std::tanh(sum - params.b0_sensitivity) + 1.0);  // eq. 11
}

}  // namespace

const std::array<IntentionRow, kIntentionCount>& intention_table() {
  static constexpr std::array<IntentionRow, kIntentionCount> kTable = {{
      {Intention::kForward, forward_potential, forward_observation, go_on},
      {Intention::kTurnLeft, turn_left_potential, turn_left_observation, turn_left},
      {Intention::kTurnRight, turn_right_potential, turn_right_observation, turn_right},
      {Intention::kDecelerate, decelerate_potential, decelerate_observation, slow_down},
  }};
  return kTable;
}

void assess_intention(const MotionCues& motion, const Surroundings& surroundings,
                      const PredictionParams& params, IntentionAssessment& assessment) {
  Evidence evidence{motion, surroundings};
  for (const auto& row : intention_table()) {
    if (row.intention == Intention::kForward) continue;
    score(row, evidence, params, assessment);
    const IntentionBelief& b = assessment[row.intention];
    evidence.strongest_potential = std::max(evidence.strongest_potential, b.potential);
    evidence.strongest_observation = std::max(evidence.strongest_observation, b.observation);
  }
  score(intention_table()[index_of(Intention::kForward)], evidence, params, assessment);
  assessment.region = surroundings.region;
  assessment.region_ahead = surroundings.region_ahead;
  assessment.obstacle_distance_m = surroundings.obstacle_distance_m;
  assessment.body_turn_rad = motion.body_turn_rad;
}

}  // namespace foretrack
