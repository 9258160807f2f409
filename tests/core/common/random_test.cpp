// SPDX-License-Identifier: Apache-2.0
#include "core/common/random.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

TEST(Random, IsTheSameEverywhere) {
  // The published first outputs of SplitMix64 for seed 1234567.
  Random random(1234567);
  EXPECT_EQ(random.next(), 6457827717110365317ULL);
  EXPECT_EQ(random.next(), 3203168211198807973ULL);
}

TEST(Random, NormalHasItsMeanAndVariance) {
  Random random(1);
  const int n = 100000;
  double sum = 0.0, squares = 0.0;
  for (int k = 0; k < n; ++k) {
    const double x = random.normal(2.0, 3.0);
    sum += x;
    squares += (x - 2.0) * (x - 2.0);
  }
  EXPECT_NEAR(sum / n, 2.0, 0.05);
  EXPECT_NEAR(squares / n, 9.0, 0.2);
}

TEST(Random, IntegersReachBothEnds) {
  Random random(2);
  int counts[3] = {};
  for (int k = 0; k < 3000; ++k) ++counts[random.integer(-1, 1) + 1];
  for (const int count : counts) EXPECT_NEAR(count, 1000, 150);
}

}  // namespace
}  // namespace foretrack
