#include "core/prediction/predict.hpp"

#include <gtest/gtest.h>

#include "tests/core/prediction/worlds.hpp"

namespace foretrack {
namespace {

using namespace foretrack::testing;

const PredictedPath* path_of(const Prediction& prediction, Intention intention) {
  for (const auto& path : prediction.paths)
    if (path.intention == intention) return &path;
  return nullptr;
}

TEST(Predict, TurnsAroundTheCornerBeforeTheTargetHasTurned) {
  PredictionState state;
  const auto& result =
      predict(state, walker({-1.0, 0.0}, {1.5, 0.0}), left_corner(), PredictionParams{});
  const PredictedPath* path = path_of(result.prediction, Intention::kTurnLeft);
  ASSERT_NE(path, nullptr);
  EXPECT_GT(path->states.back().position_enu_m.y(), 2.0);
  EXPECT_GT(path->states.back().velocity_enu_m_s.y(), 1.3);
}

}  // namespace
}  // namespace foretrack
