// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/predict_paths.hpp"

#include <gtest/gtest.h>

#include "tests/core/prediction/worlds.hpp"

namespace foretrack {
namespace {

using namespace foretrack::testing;

MotionCues cues_of(const TargetState& target) {
  MotionMemory memory;
  return observe_motion(memory, target, PredictionParams{});
}

// Paths for these probabilities, in the order of the table.
const Prediction& paths_for(PredictionState& state, const std::vector<double>& probabilities,
                            const TargetState& target, const GridMap& map,
                            const PredictionParams& params = {}) {
  state.result.intention = {};
  state.result.intention.count = kIntentionCount;
  for (std::size_t i = 0; i < probabilities.size(); ++i)
    state.result.intention.beliefs[i].probability = probabilities[i];
  predict_paths(state, target, cues_of(target), map, params);
  return state.result.prediction;
}

TEST(PredictPaths, TheLikeliestComesFirstAndTheProbabilitiesAreSharedAmongThePaths) {
  PredictionState state;
  const auto& p = paths_for(state, {0.3, 0.5, 0.02, 0.18}, walker({0, 0}, {1.5, 0}), open_field());
  ASSERT_EQ(p.paths.size(), 3u) << "0.02 is too unlikely";
  EXPECT_EQ(p.paths[0].intention, Intention::kTurnLeft);
  EXPECT_EQ(p.paths[1].intention, Intention::kForward);
  EXPECT_NEAR(p.paths[0].probability, 0.5 / 0.98, 1e-12);
  EXPECT_NEAR(p.paths[2].probability, 0.18 / 0.98, 1e-12);
}

TEST(PredictPaths, WhoStandsHasNoTurn) {
  PredictionState state;
  TargetState target = walker({0, 0}, {0, 0});
  target.body_yaw_rad = 0.0;
  const auto& p = paths_for(state, {0.3, 0.4, 0.2, 0.1}, target, open_field());
  for (const PredictedPath& path : p.paths) {
    EXPECT_NE(path.intention, Intention::kTurnLeft);
    EXPECT_NE(path.intention, Intention::kTurnRight);
  }
}

TEST(PredictPaths, WhoIsInsideAnObstacleSlowsDownWhereTheyAre) {
  PredictionState state;
  const GridMap map = map_of({{-1, 1, -1, 1}});
  const auto& p = paths_for(state, {0.6, 0.4, 0.0, 0.0}, walker({0, 0}, {1.0, 0}), map);
  EXPECT_EQ(p.status, PredictionStatus::kTargetBlocked);
  ASSERT_EQ(p.paths.size(), 1u);
  EXPECT_EQ(p.paths[0].probability, 1.0);
  EXPECT_LT(p.paths[0].states.back().velocity_enu_m_s.norm(), 1e-9);
}

TEST(PredictPaths, ABoundedSearchThatEndsIsSaid) {
  PredictionState state;
  PredictionParams params;
  params.max_expansions = 1;
  const auto& p =
      paths_for(state, {0.6, 0.4, 0.0, 0.0}, walker({0, 0}, {1.5, 0}), open_field(), params);
  EXPECT_NE(p.status, PredictionStatus::kOk);
  ASSERT_EQ(p.paths.size(), 1u);
}

TEST(PredictPaths, APathsCovarianceGrowsByTheNoiseOfItsIntention) {
  PredictionState state;
  const auto& p = paths_for(state, {0.5, 0.0, 0.0, 0.5}, walker({0, 0}, {1.5, 0}), open_field());
  ASSERT_EQ(p.paths.size(), 2u);
  for (const PredictedPath& path : p.paths)
    for (std::size_t k = 1; k < path.states.size(); ++k)
      EXPECT_GT(path.states[k].covariance_m2.trace(), path.states[k - 1].covariance_m2.trace());
}

}  // namespace
}  // namespace foretrack
