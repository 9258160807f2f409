// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/intentions/decelerate.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

using namespace foretrack::intentions;

struct Walk {
  MotionCues motion;
  Surroundings surroundings;
  PredictionParams params;

  Walk() {
    motion.speed_m_s = 1.5;
    surroundings.obstacle_distance_m = params.obstacle_range_m;
  }
  double potential() const { return kDecelerate.potential({motion, surroundings, params}); }
  double observation() const { return kDecelerate.observation({motion, surroundings, params}); }
};

TEST(Decelerate, AnObstacleSpeaksForItTheMoreTheNearerItIs) {
  Walk walk;
  EXPECT_EQ(walk.potential(), 0.0) << "nothing in range";
  double last = 0.0;
  for (const double distance_m : {4.0, 2.0, 1.0, 0.5}) {
    walk.surroundings.obstacle_distance_m = distance_m;
    EXPECT_GT(walk.potential(), last) << distance_m;
    last = walk.potential();
  }
  walk.surroundings.obstacle_distance_m = walk.params.obstacle_floor_m;
  const double at_floor = walk.potential();
  walk.surroundings.obstacle_distance_m = 0.0;
  EXPECT_EQ(walk.potential(), at_floor) << "finite at the wall";
}

TEST(Decelerate, AFallOfSpeedSpeaksForItAndARiseDoesNot) {
  Walk walk;
  walk.motion.speed_fall_m_s = 0.5;
  EXPECT_NEAR(walk.observation(), 0.5 * walk.params.k4_decelerate_observation, 1e-12);
  walk.motion.speed_fall_m_s = -0.5;
  EXPECT_EQ(walk.observation(), 0.0);
}

TEST(Decelerate, EndsAtRest) {
  const MotionModel model = kDecelerate.motion_model(PredictionParams{}, Gait{});
  EXPECT_LT(advance(model, {Vec2::Zero(), {1.5, 0.0}}, 3.0).velocity_m_s.norm(), 1e-12);
}

}  // namespace
}  // namespace foretrack
