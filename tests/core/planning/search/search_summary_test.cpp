// SPDX-License-Identifier: Apache-2.0
#include "core/planning/search/search_summary.hpp"

#include <gtest/gtest.h>

#include "tests/core/planning/search/search_world.hpp"

namespace foretrack {
namespace {

TEST(SearchSummary, SaysWhereTheBeliefIs) {
  const GridMap map = known_map(testing::empty_world(12.0), 0.15);
  const VehicleState vehicle = testing::hovering({-2.0, 0.0, 1.3}, kPi, 2.0);
  const PlanningParams params;
  LostPerson lost;
  reserve(lost);
  SearchSummary summary;
  summarize(lost, 2.0, params, summary);
  EXPECT_EQ(summary.mode, SearchMode::kNone);
  EXPECT_EQ(summary.columns * summary.rows, 0);

  begin_search(lost, testing::belief_of({3.0, 1.0, 1.2}, Vec3::Zero(), 0.5),
               {2.0, vehicle, map, vehicle.position_enu_m, Vec3::Zero()}, params);
  summarize(lost, 2.0, params, summary);
  EXPECT_EQ(summary.mode, SearchMode::kSearching);
  EXPECT_EQ(summary.unseen_s, 1.5);
  EXPECT_FALSE(summary.has_viewpoint);
  EXPECT_LT(distance_xy(summary.likeliest_enu_m, {3.0, 1.0, 1.2}), 1.0);
  int fullest = 0;
  ASSERT_GT(summary.columns * summary.rows, 0);
  for (int i = 0; i < summary.columns * summary.rows; ++i)
    if (summary.belief[i] > summary.belief[fullest]) fullest = i;
  EXPECT_EQ(summary.belief[fullest], 255);
  const Vec2 middle = summary.corner_m + summary.cell_m * Vec2(fullest % summary.columns + 0.5,
                                                               fullest / summary.columns + 0.5);
  EXPECT_LT((middle - Vec2(3.0, 1.0)).norm(), 1.1);
  lost.waits = true;
  summarize(lost, 2.0, params, summary);
  EXPECT_EQ(summary.mode, SearchMode::kWaiting);
}

}  // namespace
}  // namespace foretrack
