// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/intentions/forward.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

using namespace foretrack::intentions;

TEST(Forward, FallsWithTheStrongestOfTheOthers) {
  const MotionCues motion;
  const Surroundings surroundings;
  const PredictionParams params;
  const IntentionEvidence calm{motion, surroundings, params};
  IntentionEvidence torn = calm;
  torn.strongest_potential = 2.0;
  torn.strongest_observation = 3.0;
  EXPECT_NEAR(kForward.potential(calm) - kForward.potential(torn),
              2.0 * params.k4_forward_potential, 1e-12);
  EXPECT_NEAR(kForward.observation(calm) - kForward.observation(torn),
              3.0 * params.k5_forward_observation, 1e-12);
}

TEST(Forward, KeepsItsVelocity) {
  const MotionModel model = kForward.motion_model(PredictionParams{}, Gait{});
  EXPECT_EQ(advance(model, {Vec2::Zero(), {1.2, 0.3}}, 2.0).velocity_m_s, Vec2(1.2, 0.3));
}

}  // namespace
}  // namespace foretrack
