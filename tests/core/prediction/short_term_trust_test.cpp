// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/short_term_trust.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

constexpr double kTrustStep_s = 0.05;

// A walk along x at 2 m/s, of which each forecaster tells a velocity that is so far aside.
struct Told {
  ShortTermTrust trust;
  double stamp_s = 0.0;
  void walk(double for_s, const ByForecaster<double>& aside_m_s) {
    for (const double end_s = stamp_s + for_s; stamp_s < end_s - 1e-9; stamp_s += kTrustStep_s) {
      const PlanarState measured{{2.0 * stamp_s, 0.0}, {2.0, 0.0}};
      judge(trust, stamp_s, measured);
      ByForecaster<ShortTermMotion> said;
      for (int i = 0; i < kForecasterCount; ++i) {
        const Vec2 velocity_m_s(2.0, aside_m_s[i]);
        said[i].soon = {measured.position_m + ShortTermMotion::kSoon_s * velocity_m_s,
                        velocity_m_s};
        said[i].now = {measured.position_m, velocity_m_s};
      }
      note(trust, stamp_s, said);
    }
  }
};

TEST(ShortTermTrust, StrangersAreBelieved) {
  Told told;
  EXPECT_GT(told.trust.of(Forecaster::kChest), 0.9);
  told.walk(5.0, {0.1, 0.1, 0.1});
  EXPECT_GT(told.trust.of(Forecaster::kChest), 0.9) << "nobody is better";
}

TEST(ShortTermTrust, WhoIsWrongIsFoundOutWithinTwoSeconds) {
  Told told;
  told.walk(1.5, {1.2, 0.0, 0.0});
  EXPECT_LT(told.trust.of(Forecaster::kChest), 0.1);
  EXPECT_LT(told.trust.in_chest(), 0.2);
}

TEST(ShortTermTrust, WhoComesTrueAgainIsBelievedAgain) {
  Told told;
  told.walk(10.0, {1.2, 0.0, 0.3});
  ASSERT_LT(told.trust.of(Forecaster::kChest), 0.1);
  told.walk(4.0, {0.0, 1.2, 1.2});
  EXPECT_GT(told.trust.of(Forecaster::kChest), 0.9);
}

TEST(ShortTermTrust, WeightsSumToOne) {
  Told told;
  Random random(3);
  for (int i = 0; i < 60; ++i)
    told.walk(0.3, {3.0 * random.normal(), random.normal(), random.normal()});
  double sum = 0.0;
  for (const double weight : told.trust.weights) sum += weight;
  EXPECT_NEAR(sum, 1.0, 1e-9);
}

// The promise of ShortTermTrust, which holds whatever comes.
TEST(ShortTermTrust, LosesAsLittleAsItPromises) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Told told;
    double mixed = 0.0;
    ByForecaster<double> alone{};
    constexpr int kSeconds = 60;
    for (int i = 0; i < 10 * kSeconds; ++i) {
      ByForecaster<double> aside_m_s;
      for (double& x : aside_m_s) x = random.normal();
      if (i / 100 % 2 == 0) aside_m_s[seed % 3] *= 0.2;  // one of them is good at times
      told.walk(0.1, aside_m_s);
      const ShortTermTrust::Said& judged = told.trust.said[told.trust.oldest];
      for (int k = 0; k < kForecasterCount; ++k) {
        const double error_m = judged.position_m[k].y();
        const double loss = std::min(1.0, error_m * error_m / 0.25);
        alone[k] += loss;
        mixed += told.trust.weights[k] * loss;
      }
    }
    const double best = *std::min_element(alone.begin(), alone.end());
    EXPECT_LT(mixed, 1.6 * (best + 3.7 + 0.01 * kSeconds)) << seed;
    EXPECT_LT(mixed, 1.1 * best) << "and in truth it is hardly worse than the best alone";
  }
}

TEST(ShortTermTrust, AClockThatGoesBackForgetsWhatWasSaid) {
  Told told;
  told.walk(1.0, {1.0, 0.0, 0.0});
  ASSERT_GT(told.trust.count, 0);
  judge(told.trust, 0.2, {});
  EXPECT_EQ(told.trust.count, 0);
}

TEST(ShortTermTrust, MixesByTheWeights) {
  ShortTermTrust trust;
  trust.weights = {0.5, 0.25, 0.25};
  ByForecaster<ShortTermMotion> said;
  said[0].soon = {{4.0, 0.0}, {0.0, 4.0}};
  said[1].now = {{0.0, 8.0}, {8.0, 0.0}};
  const ShortTermMotion all = mixed(said, trust);
  EXPECT_EQ(all.soon.position_m, Vec2(2.0, 0.0));
  EXPECT_EQ(all.soon.velocity_m_s, Vec2(0.0, 2.0));
  EXPECT_EQ(all.now.position_m, Vec2(0.0, 2.0));
  EXPECT_EQ(all.now.velocity_m_s, Vec2(2.0, 0.0));
}

}  // namespace
}  // namespace foretrack
