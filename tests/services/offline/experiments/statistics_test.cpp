// SPDX-License-Identifier: Apache-2.0
#include "services/offline/experiments/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

// Every outcome of n fair coins, counted.
double brute_force_p(int only_a, int only_b) {
  const int n = only_a + only_b, k = std::min(only_a, only_b);
  int extreme = 0;
  for (int coins = 0; coins < (1 << n); ++coins) {
    const int heads = __builtin_popcount(static_cast<unsigned>(coins));
    extreme += heads <= k || heads >= n - k;
  }
  return static_cast<double>(extreme) / (1 << n);
}

TEST(McNemar, CountsAllOutcomesThatAreAsUneven) {
  for (int a = 0; a <= 7; ++a)
    for (int b = 0; b <= 7; ++b)
      EXPECT_NEAR(mcnemar_p(a, b), a + b == 0 ? 1.0 : brute_force_p(a, b), 1e-12) << a << " " << b;
}

TEST(McNemar, IsSymmetricAndSureOfAClearSplit) {
  EXPECT_EQ(mcnemar_p(3, 40), mcnemar_p(40, 3));
  EXPECT_LT(mcnemar_p(40, 3), 1e-8);
  EXPECT_EQ(mcnemar_p(20, 20), 1.0);
  EXPECT_GT(mcnemar_p(1000, 980), 0.5);
}

TEST(Bootstrap, CoversTheMeanOfANormalSample) {
  int covered = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    std::vector<double> values;
    for (int i = 0; i < 40; ++i) values.push_back(random.normal(0.3, 1.0));
    const MeanInterval m = bootstrap_mean(values, seed, 400);
    covered += m.low <= 0.3 && m.high >= 0.3;
    EXPECT_LE(m.low, m.mean);
    EXPECT_GE(m.high, m.mean);
  }
  EXPECT_GE(covered, 178);  // 95 % would be 190; percentile intervals of 40 values are a bit short
  EXPECT_LE(covered, 200);
}

TEST(Bootstrap, IsTheSameForTheSameSeedAndEmptyForNothing) {
  const std::vector<double> values = {0.1, 0.4, -0.2, 0.9};
  EXPECT_EQ(bootstrap_mean(values, 7).low, bootstrap_mean(values, 7).low);
  EXPECT_EQ(bootstrap_mean({}, 7).mean, 0.0);
  const std::vector<double> constant(5, 0.25);
  EXPECT_TRUE(bootstrap_mean(constant, 1).excludes_zero());
  EXPECT_EQ(bootstrap_mean(constant, 1).low, 0.25);
}

}  // namespace
}  // namespace foretrack
