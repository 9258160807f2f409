// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/intentions/turn.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace foretrack {
namespace {

using namespace foretrack::intentions;

// Walks along a wall on the right that ends; the chest turns to the right.
struct Corner {
  MotionCues motion;
  Surroundings surroundings;
  PredictionParams params;

  Corner() {
    motion.speed_m_s = 1.4;
    motion.turn_rate_rad_s = -0.4;
    motion.recent_turn_rad = -0.2;
    motion.body_turn_rad = -0.5;
    motion.steady_body_turn_rad = -0.4;
    motion.soon_turn_rad = -0.1;
    motion.body_swing_rad = {-0.1, -0.3, -0.5};
    surroundings.obstacle_distance_m = 2.0;
    surroundings.region = {.left_half_angle_rad = 0.3, .right_half_angle_rad = 0.1};
    surroundings.region_ahead = {.left_half_angle_rad = 0.2, .right_half_angle_rad = 0.6};
    surroundings.left_width_m = {2.0, 1.8, 1.6, 1.4, 1.2, 1.0, 0.8};
    surroundings.right_width_m = {0.4, 0.4, 0.5, 2.0, 2.5, 2.5, 2.5};
  }
  Corner mirrored() const {
    Corner m = *this;
    for (double* angle_rad :
         {&m.motion.turn_rate_rad_s, &m.motion.recent_turn_rad, &m.motion.body_turn_rad,
          &m.motion.steady_body_turn_rad, &m.motion.soon_turn_rad})
      *angle_rad = -*angle_rad;
    for (double& swing_rad : m.motion.body_swing_rad) swing_rad = -swing_rad;
    for (ReachableRegion* region : {&m.surroundings.region, &m.surroundings.region_ahead})
      std::swap(region->left_half_angle_rad, region->right_half_angle_rad);
    std::swap(m.surroundings.left_width_m, m.surroundings.right_width_m);
    return m;
  }
  IntentionEvidence evidence() const { return {motion, surroundings, params}; }
  std::vector<double> features(const IntentionRow& row) const {
    FeatureVector features;
    const IntentionEvidence now = evidence();
    row.features({now, {row.potential(now), row.observation(now)}, true}, features);
    const auto written = features.first(features.written());
    return {written.begin(), written.end()};
  }
};

TEST(Turn, AnOpeningAheadSpeaksForItsSideAlone) {
  const Corner corner;
  EXPECT_NEAR(kTurnRight.potential(corner.evidence()), 0.5 * corner.params.k1_turn_potential,
              1e-12);
  EXPECT_EQ(kTurnLeft.potential(corner.evidence()), 0.0);
}

TEST(Turn, AChestThatIsTurnedSpeaksForItsSideAlone) {
  const Corner corner;
  EXPECT_NEAR(kTurnRight.observation(corner.evidence()), 0.5 * corner.params.k2_turn_observation,
              1e-12);
  EXPECT_EQ(kTurnLeft.observation(corner.evidence()), 0.0);
}

TEST(Turn, LeftOfAMirroredWalkIsRight) {
  const Corner corner, mirrored = corner.mirrored();
  EXPECT_NE(kTurnLeft.features, kTurnRight.features);
  EXPECT_EQ(mirrored.features(kTurnLeft), corner.features(kTurnRight));
  EXPECT_EQ(mirrored.features(kTurnRight), corner.features(kTurnLeft));
  EXPECT_NE(corner.features(kTurnLeft), corner.features(kTurnRight));
  EXPECT_EQ(kTurnLeft.motion_model(corner.params, {}).rate,
            -kTurnRight.motion_model(corner.params, {}).rate);
  EXPECT_GT(kTurnLeft.motion_model(corner.params, {}).rate, 0.0);
}

}  // namespace
}  // namespace foretrack
