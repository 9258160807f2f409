// SPDX-License-Identifier: Apache-2.0
#include "core/planning/see/target_samples.hpp"

#include <gtest/gtest.h>

#include "tests/core/planning/see/expected_walks.hpp"

namespace foretrack {
namespace {

using testing::add_walk;
using testing::empty_world;
using testing::FlatContext;
using testing::kExpectedStep_s;
using testing::kExpectedSteps;

constexpr double kSampleHeight_m = 1.5;
const Vec3 kSampleTarget(0.0, 0.0, 1.0), kSampleAlong(1.5, 0.0, 0.0);

class TargetSamples : public ::testing::Test {
 protected:
  TargetSamples() : c_(known_map(empty_world(12.0), 0.15), kSampleHeight_m) {}

  void sample(const Vec3& from = {-2.1, 0.0, kSampleHeight_m}, double score_decelerate = 0.0) {
    StageClock clock;
    LookAhead ahead;
    FlightPathWorkspace timing;
    FlightPath path;
    const SearchContext context = c_.context();
    look_ahead(context, from, Vec3::Zero(), expected_, nullptr, clock, ahead);
    make_flight_path(context, ahead.way, 0.0, timing, path);
    make_samples(context, expected_, ahead, timing, {from, Vec3::Zero(), Vec3::Zero()},
                 score_decelerate, samples_);
  }
  double discount(double time_s) const {
    return std::exp(-c_.params.horizon.later_discount_per_s * time_s);
  }
  // Sum of the weights at t_k.
  double weight_at(double time_s) const {
    double sum = 0.0;
    for (const TargetSample& s : samples_)
      if (std::abs(s.time_s - time_s) < 1e-9) sum += s.weight;
    return sum;
  }
  FlatContext c_;
  ExpectedTarget expected_;
  std::vector<TargetSample> samples_;
};

TEST_F(TargetSamples, OnePathHasOneSampleAStepThatCountsLessTheLaterItIs) {
  add_walk(expected_, 1.0, kSampleTarget, kSampleAlong);
  sample();
  ASSERT_EQ(samples_.size(), std::size_t{kExpectedSteps});
  for (std::size_t k = 0; k < samples_.size(); ++k) {
    const TargetSample& s = samples_[k];
    EXPECT_NEAR(s.time_s, kExpectedStep_s * static_cast<double>(k + 1), 1e-9);
    EXPECT_NEAR(s.weight, discount(s.time_s), 1e-9);
    EXPECT_EQ(s.target_enu_m, expected_.paths[0].positions_enu_m[k]);
    EXPECT_TRUE(s.has_region);
    EXPECT_EQ(s.has_next, k + 1 < samples_.size());
    EXPECT_LE(s.distance_low_m, c_.params.place.kept_low_m() + 1e-9);
    EXPECT_GE(s.distance_high_m, c_.params.place.kept_high_m() - 1e-9);
  }
}

TEST_F(TargetSamples, PathsThatRunTogetherAreOneSampleAndTheirWeightsAddUp) {
  add_walk(expected_, 0.7, kSampleTarget, kSampleAlong);
  add_walk(expected_, 0.3, kSampleTarget, kSampleAlong, 1.0, {0.0, 1.5, 0.0});
  sample();
  EXPECT_GT(samples_.size(), std::size_t{kExpectedSteps});
  EXPECT_LT(samples_.size(), std::size_t{2 * kExpectedSteps});
  EXPECT_NEAR(samples_.front().weight, discount(kExpectedStep_s), 1e-9) << "both paths'";
  EXPECT_NEAR(samples_.back().weight, 0.3 * discount(samples_.back().time_s), 1e-9);
  for (int k = 1; k <= kExpectedSteps; ++k)
    EXPECT_NEAR(weight_at(kExpectedStep_s * k), discount(kExpectedStep_s * k), 1e-9) << k;
}

TEST_F(TargetSamples, ALikelyDecelerationKeepsTheVehicleFartherAway) {
  add_walk(expected_, 1.0, kSampleTarget, Vec3::Zero());
  sample();
  const double low_m = samples_.back().distance_low_m;
  sample({-2.1, 0.0, kSampleHeight_m}, 1.0);
  EXPECT_GT(samples_.back().distance_low_m, low_m + 0.05);
  EXPECT_NEAR(samples_.back().distance_low_m, c_.params.place.kept_low_m(1.0), 1e-9);
}

TEST_F(TargetSamples, WhatCannotBeReachedInTimeIsNotAskedFor) {
  add_walk(expected_, 1.0, kSampleTarget, Vec3::Zero());
  sample({-9.0, 0.0, kSampleHeight_m});
  const double most_m =
      0.5 * c_.params.limits.acceleration_max_m_s2 * kExpectedStep_s * kExpectedStep_s;
  EXPECT_GE(samples_.front().distance_high_m, 9.0 - most_m);
  EXPECT_LE(samples_.front().distance_high_m, 9.0);
  for (std::size_t k = 1; k < samples_.size(); ++k)
    EXPECT_LE(samples_[k].distance_high_m, samples_[k - 1].distance_high_m + 1e-9);
  EXPECT_LT(samples_.back().distance_high_m, 4.0) << "three seconds later it can be there";
}

TEST_F(TargetSamples, NeitherIsADistanceThatItCannotTakeSoSoon) {
  add_walk(expected_, 1.0, kSampleTarget, Vec3::Zero());
  sample({-0.8, 0.0, kSampleHeight_m});
  EXPECT_LT(samples_.front().distance_low_m, 1.0);
  EXPECT_NEAR(samples_.back().distance_low_m, c_.params.place.kept_low_m(), 1e-9);
}

}  // namespace
}  // namespace foretrack
