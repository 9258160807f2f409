// SPDX-License-Identifier: Apache-2.0
// Counts heap allocations in this program: predict() must make none once it is warm.
#include <gtest/gtest.h>

#include "core/prediction/predict.hpp"
#include "tests/core/prediction/worlds.hpp"
#include "tests/support/count_allocations.hpp"

namespace foretrack {
namespace {

using namespace foretrack::testing;

// Walks through a bend and stops, so that all numbers of paths and all statuses come up.
long allocations_of_walk(PredictionState& state, const GridMap& map, double start_s) {
  const PredictionParams params;
  const long before = allocation_count();
  for (int i = 0; i < 120; ++i) {
    const double t = 0.04 * i;
    TargetState target = walker({-3.0 + 1.5 * t, 0.0}, {1.5, 0.0}, start_s + t);
    if (t > 2.5) target.velocity_enu_m_s.setZero();
    if (i % 40 == 39) target.status = TrackStatus::kLost;
    predict(state, target, map, params);
  }
  return allocation_count() - before;
}

TEST(Predict, AllocatesNothingOnceItIsWarm) {
  const GridMap map = left_branch();
  PredictionState state;
  EXPECT_GT(allocations_of_walk(state, map, 0.0), 0);  // the counter counts
  EXPECT_EQ(allocations_of_walk(state, map, 10.0), 0);
}

}  // namespace
}  // namespace foretrack
