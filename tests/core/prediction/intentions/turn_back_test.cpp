// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/intentions/turn_back.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace foretrack {
namespace {

using namespace foretrack::intentions;

struct DeadEnd {
  MotionCues motion;
  Surroundings surroundings;
  PredictionParams params;

  DeadEnd() {
    motion.speed_m_s = 1.5;
    surroundings.obstacle_distance_m = 1.0;
  }
  double potential() const { return kTurnBack.potential({motion, surroundings, params}); }
  double observation() const { return kTurnBack.observation({motion, surroundings, params}); }
  std::vector<double> features() const {
    FeatureVector features;
    write_turn_back({{motion, surroundings, params}, {}, true}, features);
    const auto written = features.first(features.written());
    return {written.begin(), written.end()};
  }
};

TEST(TurnBack, ADeadEndSpeaksForItAndAWayToOneSideDoesNot) {
  DeadEnd walk;
  EXPECT_GT(walk.potential(), 0.0);
  walk.surroundings.region_ahead.right_half_angle_rad = kPi / 4.0;
  EXPECT_EQ(walk.potential(), 0.0);
  walk.surroundings.region_ahead.right_half_angle_rad = 0.0;
  walk.surroundings.obstacle_distance_m = walk.params.obstacle_range_m;
  EXPECT_EQ(walk.potential(), 0.0) << "nothing in range";
}

TEST(TurnBack, OnlyAChestThatIsTurnedFurtherThanForACornerSpeaksForIt) {
  DeadEnd walk;
  walk.motion.body_turn_rad = kChestAside_rad;
  EXPECT_EQ(walk.observation(), 0.0);
  for (const double side : {1.0, -1.0}) {
    walk.motion.body_turn_rad = side * (kChestAside_rad + 0.5);
    EXPECT_NEAR(walk.observation(), 0.5 * walk.params.k2_turn_observation, 1e-12);
  }
}

TEST(TurnBack, DoesNotAskWhichWayRoundTheChestTurns) {
  DeadEnd left, right;
  left.motion.body_turn_rad = 1.0;
  left.motion.soon_turn_rad = 1.2;
  left.motion.body_swing_rad = {0.5, 1.0, 2.0};
  right.motion.body_turn_rad = -1.0;
  right.motion.soon_turn_rad = -1.2;
  right.motion.body_swing_rad = {-0.5, -1.0, -2.0};
  EXPECT_EQ(left.features(), right.features());
  EXPECT_NE(left.features(), DeadEnd().features());
}

TEST(TurnBack, EndsWalkingBackAtThePaceThatTheyHad) {
  const MotionModel model =
      kTurnBack.motion_model(PredictionParams{}, {.pace_m_s = 1.4, .back_rad = kPi});
  const Vec2 velocity = advance(model, {Vec2::Zero(), {1.4, 0.0}}, 3.0).velocity_m_s;
  EXPECT_LT((velocity - Vec2(-1.4, 0.0)).norm(), 1e-9);
}

}  // namespace
}  // namespace foretrack
