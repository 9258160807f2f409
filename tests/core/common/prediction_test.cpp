// SPDX-License-Identifier: Apache-2.0
#include "core/common/prediction.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

// Along x at 1 m/s until 1 s, then along y.
PredictedPath corner() {
  PredictedPath path;
  path.states.push_back(
      {.time_s = 1.0, .position_enu_m = {1, 0, 0}, .velocity_enu_m_s = {1, 0, 0}});
  path.states.push_back(
      {.time_s = 2.0, .position_enu_m = {1, 1, 0}, .velocity_enu_m_s = {0, 2, 0}});
  return path;
}

TEST(PredictedPath, IsAtItsStatesAtTheirTimes) {
  EXPECT_EQ(corner().at(1.0).position_enu_m, Vec3(1, 0, 0));
  EXPECT_EQ(corner().at(2.0).position_enu_m, Vec3(1, 1, 0));
  EXPECT_EQ(corner().at(2.0).velocity_enu_m_s, Vec3(0, 2, 0));
}

TEST(PredictedPath, IsStraightBetweenThem) {
  const PathPoint middle = corner().at(1.25);
  EXPECT_NEAR((middle.position_enu_m - Vec3(1, 0.25, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((middle.velocity_enu_m_s - Vec3(0.75, 0.5, 0)).norm(), 0.0, 1e-12);
}

TEST(PredictedPath, GoesOnAtBothEndsAsItIsThere) {
  EXPECT_NEAR((corner().at(0.0).position_enu_m - Vec3(0, 0, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((corner().at(2.5).position_enu_m - Vec3(1, 2, 0)).norm(), 0.0, 1e-12);
}

TEST(IntentionAssessment, TheMostLikelyIsAmongThoseThatThereAre) {
  IntentionAssessment a;
  a.count = 2;
  a.beliefs[1].probability = 0.4;
  a.beliefs[2].probability = 0.9;
  EXPECT_EQ(a.most_likely(), Intention{1});
}

}  // namespace
}  // namespace foretrack
