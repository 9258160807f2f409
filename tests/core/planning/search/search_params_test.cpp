// SPDX-License-Identifier: Apache-2.0
#include "core/planning/search/search_params.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

TEST(SafeSpeed, LeavesTheGapWhenBothComeTogether) {
  const SearchParams p;
  const double person_m_s = 2.0;
  for (const double free_m : {3.0, 4.0, 6.0}) {
    const double v = safe_speed_m_s(free_m, person_m_s, p);
    ASSERT_GT(v, 0.0);
    const double stop_s = p.search_reaction_s + v / p.search_braking_m_s2;
    const double used_m =
        v * p.search_reaction_s + 0.5 * v * v / p.search_braking_m_s2 + person_m_s * stop_s;
    EXPECT_NEAR(free_m - used_m, p.search_gap_m, 1e-9);
  }
}

TEST(SafeSpeed, IsNothingWhereThePersonIsTooNearAndGrowsWithTheRoom) {
  const SearchParams p;
  EXPECT_EQ(safe_speed_m_s(1.5, 2.0, p), 0.0);
  EXPECT_LT(safe_speed_m_s(3.0, 2.0, p), safe_speed_m_s(5.0, 2.0, p));
  EXPECT_LT(safe_speed_m_s(5.0, 2.0, p), safe_speed_m_s(5.0, 1.0, p));
}

}  // namespace
}  // namespace foretrack
