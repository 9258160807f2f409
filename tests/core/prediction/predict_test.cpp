// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/predict.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/core/prediction/worlds.hpp"

namespace foretrack {
namespace {

using namespace foretrack::testing;

const PredictedPath* path_of(const Prediction& prediction, Intention intention) {
  for (const auto& path : prediction.paths)
    if (path.intention == intention) return &path;
  return nullptr;
}

void expect_sound(const PredictionResult& result, const PredictionParams& params) {
  const Prediction& prediction = result.prediction;
  double sum = 0.0, before = 1.0;
  for (const PredictedPath& path : prediction.paths) {
    sum += path.probability;
    EXPECT_LE(path.probability, before);
    before = path.probability;
    ASSERT_EQ(static_cast<int>(path.states.size()), params.step_count());
    for (int k = 0; k < params.step_count(); ++k) {
      const PredictedState& z = path.states[k];
      EXPECT_NEAR(z.time_s, (k + 1) * params.step_s, 1e-9);
      EXPECT_TRUE(z.position_enu_m.allFinite() && z.velocity_enu_m_s.allFinite());
      EXPECT_GT(z.covariance_m2.determinant(), 0.0);
      EXPECT_GT(z.covariance_m2(0, 0), 0.0);
    }
  }
  EXPECT_NEAR(sum, prediction.paths.empty() ? 0.0 : 1.0, 1e-12);
}

TEST(Predict, TurnsAroundTheCornerBeforeTheTargetHasTurned) {
  PredictionState state;
  const PredictionParams params;
  const auto& result = predict(state, walker({-0.5, 0.0}, {1.5, 0.0}), left_corner(), params);
  expect_sound(result, params);
  const PredictedPath* path = path_of(result.prediction, Intention::kTurnLeft);
  ASSERT_NE(path, nullptr);
  EXPECT_GT(path->states.back().position_enu_m.y(), 2.0);
  EXPECT_GT(path->states.back().velocity_enu_m_s.y(), 1.3);
  EXPECT_EQ(path_of(result.prediction, Intention::kTurnRight), nullptr);  // a wall is there
}

// What shows already happens whatever the target means to do.
TEST(Predict, BeginsAllPathsWithWhatShowsAlready) {
  const GridMap map = open_field();
  PredictionState state;
  PredictionParams params;
  params.path_probability_min = 0.0;
  const PredictionResult* result = nullptr;
  MotionMemory memory;  // before the last of them
  TargetState target;
  for (int i = 0; i <= 20; ++i) {  // the chest turns to the left, the way does not yet
    target = walker({0.06 * i, 0.0}, {1.5, 0.0}, 0.04 * i);
    target.body_yaw_rad = std::max(0.0, 0.12 * (i - 14));
    memory = state.memory;
    result = &predict(state, target, map, params);
  }
  const MotionCues motion = observe_motion(memory, target, params);
  EXPECT_GT(yaw_of(motion.soon.velocity_m_s), 0.1);
  const PredictedPath* forward = path_of(result->prediction, Intention::kForward);
  ASSERT_NE(forward, nullptr);
  ASSERT_EQ(params.step_s, ShortTermMotion::kSoon_s);
  EXPECT_LT((forward->states[0].position_enu_m.head<2>() - motion.soon.position_m).norm(), 1e-9);
  EXPECT_LT((forward->states[9].velocity_enu_m_s.head<2>() - motion.soon.velocity_m_s).norm(),
            1e-9);
  const PredictedPath* left = path_of(result->prediction, Intention::kTurnLeft);
  ASSERT_NE(left, nullptr);
  EXPECT_GT(left->states[0].velocity_enu_m_s.y(), motion.soon.velocity_m_s.y());
}

TEST(Predict, PutsTheTurnFirstWhenTheChestHasTurnedAtTheCorner) {
  PredictionState state;
  const GridMap map = left_branch();
  const PredictionParams params;
  const PredictionResult* result = nullptr;
  for (int i = 0; i <= 25; ++i) {
    const double t = 0.04 * i;
    TargetState target = walker({-1.3 + 1.5 * t, 0.0}, {1.5, 0.0}, t);
    target.body_yaw_rad = std::max(0.0, 2.5 * (t - 0.7));
    result = &predict(state, target, map, params);
    EXPECT_TRUE(i != 10 || result->intention.most_likely() == Intention::kForward);
  }
  EXPECT_EQ(result->prediction.paths.front().intention, Intention::kTurnLeft);
  EXPECT_GT(result->prediction.paths.front().probability, 0.5);
}

TEST(Predict, GivesEachPossibleIntentionItsPathInTheOpen) {
  PredictionState state;
  PredictionParams params;
  params.path_probability_min = 0.0;
  const auto& result = predict(state, walker({0, 0}, {1.5, 0.0}), open_field(), params);
  EXPECT_EQ(result.prediction.status, PredictionStatus::kOk);
  EXPECT_EQ(result.prediction.paths.size(), kIntentions.size());
  expect_sound(result, params);
  for (const auto& path : result.prediction.paths)
    EXPECT_NEAR(path.probability, result.intention[path.intention].probability, 1e-12);
}

TEST(Predict, SharesTheProbabilityOfImpossibleIntentionsAmongTheOthers) {
  PredictionState state;
  PredictionParams params;
  params.path_probability_min = 0.0;
  const auto& result = predict(state, walker({-2, 0}, {1.5, 0.0}), narrow_corridor(), params);
  ASSERT_EQ(result.prediction.paths.size(), 3u) << "no turn to a side";
  expect_sound(result, params);
  const double ratio =
      result.prediction.paths[0].probability / result.prediction.paths[1].probability;
  EXPECT_NEAR(ratio,
              result.intention[result.prediction.paths[0].intention].probability /
                  result.intention[result.prediction.paths[1].intention].probability,
              1e-9);
}

TEST(Predict, LeavesOutPathsThatAreTooUnlikelyToMatter) {
  PredictionParams params;
  PredictionState all, likely;
  params.path_probability_min = 0.0;
  TargetState target = walker({0, 0}, {1.5, 0.0});
  target.body_yaw_rad = rad(3.0);  // else both turns are as likely
  const auto& complete = predict(all, target, open_field(), params).prediction;
  ASSERT_EQ(complete.paths.size(), kIntentions.size());
  const std::size_t last = complete.paths.size() - 1;
  params.path_probability_min =
      0.5 * (complete.paths[last - 1].probability + complete.paths[last].probability);
  const auto& result = predict(likely, target, open_field(), params);
  ASSERT_EQ(result.prediction.paths.size(), last);
  expect_sound(result, params);
  EXPECT_EQ(path_of(result.prediction, complete.paths[last].intention), nullptr);
  params.path_probability_min = 0.25;  // the likeliest is always there
  EXPECT_GE(predict(likely, walker({0, 0}, {1.5, 0.0}, 2.0), left_branch(), params)
                .prediction.paths.size(),
            1u);
}

TEST(Predict, ExpectsAStopOnceTheSpeedFallsAndTheChestDoesNotTurn) {
  PredictionState state;
  const PredictionParams params;
  double before = 0.0, braking = 0.0, x_m = 0.0, speed_m_s = 1.5;
  for (int i = 0; i <= 35; ++i) {
    speed_m_s -= i > 25 ? 3.0 * 0.04 : 0.0;
    x_m += 0.04 * speed_m_s;
    const auto& result = predict(state, walker({x_m - 4.0, 0.0}, {speed_m_s, 0.0}, 0.04 * i),
                                 narrow_corridor(), params);
    const double p = result.intention[Intention::kDecelerate].probability;
    if (i <= 25)
      before = p;
    else
      braking = std::max(braking, p);
  }
  EXPECT_LT(before, 0.05);
  EXPECT_GT(braking, 0.2);
  EXPECT_GT(braking, 20.0 * before);
}

TEST(Predict, ExpectsWhoBrakesWithTheChestTurnedRoundToComeBack) {
  PredictionState state;
  const PredictionParams params;
  double before = 0.0, turning = 0.0, x_m = 0.0, speed_m_s = 1.5, chest_rad = 0.0;
  double end_m = 0.0;
  const PredictedPath* back = nullptr;
  for (int i = 0; i <= 34; ++i) {
    const bool turns = i > 22;
    speed_m_s -= turns ? 3.0 * 0.04 : 0.0;
    chest_rad = turns ? std::min(kPi, chest_rad + 5.0 * 0.04) : 0.0;
    x_m += 0.04 * speed_m_s;
    TargetState target = walker({x_m - 2.0, 0.0}, {speed_m_s, 0.0}, 0.04 * i);
    target.body_yaw_rad = wrap_angle(chest_rad);
    const auto& result = predict(state, target, open_field(), params);
    const double p = result.intention[Intention::kTurnBack].probability;
    if (!turns) before = p;
    if (turns && p > turning) {
      turning = p;
      back = path_of(result.prediction, Intention::kTurnBack);
      if (back) end_m = back->states.back().position_enu_m.x() - target.position_enu_m.x();
    }
  }
  EXPECT_LT(before, 0.02);
  EXPECT_GT(turning, 0.1);  // in the open, where nothing else tells it
  ASSERT_NE(back, nullptr);
  EXPECT_LT(end_m, -1.5) << "a path that comes back";
}

TEST(Predict, HardlyLeavesItsPlaceAtZeroSpeed) {
  PredictionState state;
  const PredictionParams params;
  TargetState target = walker({0, 0}, {0, 0});
  target.body_yaw_rad = 1.0;
  const auto& result = predict(state, target, left_branch(), params);
  expect_sound(result, params);
  for (const auto& path : result.prediction.paths)
    EXPECT_LT((path.states.back().position_enu_m - target.position_enu_m).norm(), 0.5);
  EXPECT_NEAR(result.intention.region.heading_rad, 1.0, 1e-12);
}

TEST(Predict, GrowsTheCovarianceAsTheIntegralOfItsModel) {
  PredictionState state;
  PredictionParams params;
  TargetState target = walker({0, 0}, {1.0, 0.0});
  const auto& result = predict(state, target, open_field(), params);
  const PredictedPath* forward = path_of(result.prediction, Intention::kForward);
  ASSERT_NE(forward, nullptr);
  // Constant velocity from independent errors: P + t² V + q t³ / 3.
  for (const PredictedState& z : forward->states) {
    const double t = z.time_s;
    const double expected = 0.01 + t * t * 0.01 + kIntentions.front().noise_m2_s3 * t * t * t / 3.0;
    EXPECT_NEAR(z.covariance_m2(0, 0), expected, 1e-9);
    EXPECT_NEAR(z.covariance_m2(1, 1), expected, 1e-9);
  }
}

TEST(Predict, SaysThatThereIsNoTarget) {
  PredictionState state;
  const PredictionParams params;
  predict(state, walker({0, 0}, {1, 0}), open_field(), params);
  TargetState lost = walker({0, 0}, {1, 0}, 2.0);
  lost.status = TrackStatus::kLost;
  EXPECT_EQ(predict(state, lost, open_field(), params).prediction.status,
            PredictionStatus::kNoTarget);
  EXPECT_TRUE(state.result.prediction.paths.empty());
  TargetState broken = walker({0, 0}, {1, 0}, 2.0);
  broken.velocity_enu_m_s.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(predict(state, broken, open_field(), params).prediction.status,
            PredictionStatus::kNoTarget);
}

TEST(Predict, SlowsDownATargetThatSeemsToBeInsideAnObstacle) {
  PredictionState state;
  const PredictionParams params;
  const GridMap map = map_of({{-1, 1, -1, 1}});
  const auto& result = predict(state, walker({0, 0}, {1.0, 0.0}), map, params);
  EXPECT_EQ(result.prediction.status, PredictionStatus::kTargetBlocked);
  ASSERT_EQ(result.prediction.paths.size(), 1u);
  expect_sound(result, params);
  EXPECT_NEAR(result.prediction.paths[0].states.back().velocity_enu_m_s.norm(), 0.0, 1e-9);
}

TEST(Predict, WorksWithoutAMapAndWithoutABodyYaw) {
  PredictionState state;
  const PredictionParams params;
  TargetState target = walker({0, 0}, {1.2, 0.3});
  target.body_yaw_rad = std::numeric_limits<double>::quiet_NaN();
  const auto& result = predict(state, target, GridMap{}, params);
  EXPECT_EQ(result.prediction.status, PredictionStatus::kOk);
  expect_sound(result, params);
}

TEST(Predict, GivesTheSameResultForTheSameInput) {
  const PredictionParams params;
  PredictionState a, b;
  predict(b, walker({3, 3}, {0.5, 0.5}, 0.9), left_corner(), params);  // another history of work
  b.memory = {};
  const auto& x = predict(a, walker({-1, 0.2}, {1.4, 0.1}), left_corner(), params);
  const auto& y = predict(b, walker({-1, 0.2}, {1.4, 0.1}), left_corner(), params);
  ASSERT_EQ(x.prediction.paths.size(), y.prediction.paths.size());
  EXPECT_EQ(x.prediction.expansions, y.prediction.expansions);
  for (std::size_t i = 0; i < x.prediction.paths.size(); ++i) {
    EXPECT_EQ(x.prediction.paths[i].probability, y.prediction.paths[i].probability);
    EXPECT_EQ(x.prediction.paths[i].states.back().position_enu_m,
              y.prediction.paths[i].states.back().position_enu_m);
  }
}

TEST(Predict, WithoutIntentionsGoesStraightUnlessBlocked) {
  PredictionParams params;
  params.intention_paths = false;
  PredictionState state;
  const auto& open = predict(state, walker({0.0, 0.0}, {1.5, 0.0}), open_field(), params);
  ASSERT_EQ(open.prediction.paths.size(), 1u);
  EXPECT_EQ(open.prediction.paths[0].probability, 1.0);
  EXPECT_NEAR(open.prediction.paths[0].states.back().position_enu_m.x(), 4.5, 0.3);
  const auto& corner = predict(state, walker({-1.0, 0.0}, {1.5, 0.0}, 3.0), left_corner(), params);
  ASSERT_EQ(corner.prediction.paths.size(), 1u);
  expect_sound(corner, params);
  EXPECT_LT(corner.prediction.paths[0].states.back().position_enu_m.x(), 2.0);
}

TEST(Predict, ConstantVelocityMindsNoWall) {
  PredictionParams params;
  params.around_obstacles = false;
  PredictionState state;
  const auto& result = predict(state, walker({-1.0, 0.0}, {1.5, 0.0}), left_corner(), params);
  ASSERT_EQ(result.prediction.paths.size(), 1u);
  expect_sound(result, params);
  EXPECT_NEAR(result.prediction.paths[0].states.back().position_enu_m.x(), 3.5, 0.3);
}

}  // namespace
}  // namespace foretrack
