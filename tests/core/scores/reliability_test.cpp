// SPDX-License-Identifier: Apache-2.0
#include "core/scores/reliability.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

TEST(Reliability, TheCalibrationErrorIsTheGapOfAnOverconfidentForecast) {
  std::vector<std::pair<double, bool>> pairs;
  for (int i = 0; i < 300; ++i) pairs.emplace_back(0.9, i % 10 < 6);
  EXPECT_NEAR(expected_calibration_error(reliability_bins(pairs, 15)), 0.3, 1e-9);
}

std::vector<std::pair<double, bool>> random_pairs(int count) {
  Random random(1);
  std::vector<std::pair<double, bool>> pairs;
  for (int i = 0; i < count; ++i) {
    const double p = random.uniform();
    pairs.emplace_back(p, random.chance(p));
  }
  return pairs;
}

TEST(Reliability, BinsHaveEqualMassAndRisingProbability) {
  const auto bins = reliability_bins(random_pairs(1003), 15);
  ASSERT_EQ(bins.size(), 15U);
  int sum = 0;
  for (std::size_t b = 0; b < bins.size(); ++b) {
    EXPECT_TRUE(bins[b].count == 66 || bins[b].count == 67);
    if (b > 0) {
      EXPECT_GT(bins[b].probability, bins[b - 1].probability);
    }
    sum += bins[b].count;
  }
  EXPECT_EQ(sum, 1003);
}

TEST(Reliability, BinsHoldTheMeansOfTheirForecasts) {
  const auto bins = reliability_bins({{0.8, true}, {0.1, false}, {0.3, true}, {0.6, true}}, 2);
  ASSERT_EQ(bins.size(), 2U);
  EXPECT_DOUBLE_EQ(bins[0].probability, 0.2);
  EXPECT_DOUBLE_EQ(bins[0].frequency, 0.5);
  EXPECT_DOUBLE_EQ(bins[1].probability, 0.7);
  EXPECT_DOUBLE_EQ(bins[1].frequency, 1.0);
}

TEST(Reliability, AnHonestForecastHasNearlyNoCalibrationError) {
  EXPECT_LT(expected_calibration_error(reliability_bins(random_pairs(30000), 15)), 0.01);
}

TEST(Reliability, BinsThatWouldBeEmptyAreLeftOut) {
  EXPECT_EQ(reliability_bins(random_pairs(4), 15).size(), 4U);
  EXPECT_TRUE(reliability_bins({}, 15).empty());
  EXPECT_EQ(expected_calibration_error({}), 0.0);
}

// A forecast that is always the same: sorted by what came true, the bins would be all or nothing.
TEST(Reliability, ForecastsOfOneProbabilityStayInTheirOrder) {
  std::vector<std::pair<double, bool>> pairs;
  for (int i = 0; i < 60; ++i) pairs.emplace_back(0.5, i % 2 == 0);
  for (const auto& bin : reliability_bins(pairs, 6)) EXPECT_DOUBLE_EQ(bin.frequency, 0.5);
}

}  // namespace
}  // namespace foretrack
