// SPDX-License-Identifier: Apache-2.0
#include "services/convert/checks.hpp"

#include "convert_test_support.hpp"

namespace foretrack {
namespace {

using testing::kInf;
using testing::kNaN;

TEST(Checks, KeepsTheFirstFaultAndNamesFieldValueAndExpectation) {
  Checks checks;
  checks.in_range("height_m", 3.0, 0.0, 2.0);
  checks.within("other", kNaN, 1.0);
  const auto refused = checks.result(1);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.fault().field, "height_m");
  EXPECT_EQ(refused.fault().text, "height_m is 3, expected 0 to 2");
}

TEST(Checks, RefuseNaNAndInfinityInEveryNumericCheck) {
  for (const double bad : {kNaN, kInf, -kInf}) {
    Checks range, positive, within, sum, unit;
    range.in_range("x", bad, -1.0, 1.0);
    positive.positive("x", bad, 1.0);
    within.within("x", bad, 1.0);
    sum.sums_to_one("x", bad);
    unit.unit("x", bad);
    for (const Checks* c : {&range, &positive, &within, &sum, &unit}) EXPECT_FALSE(c->ok()) << bad;
  }
}

TEST(Checks, CovariancesMustBeSymmetricWithVariancesAndPossibleCorrelations) {
  const auto accepts = [](std::array<double, 4> c) {
    Checks checks;
    checks.covariance("c", c.data(), 2);
    return checks.ok();
  };
  EXPECT_TRUE(accepts({1.0, 0.5, 0.5, 1.0}));
  EXPECT_TRUE(accepts({0.0, 0.0, 0.0, 0.0}));
  EXPECT_TRUE(accepts({1.0, 2.0, 2.0, 4.0}));  // fully correlated
  EXPECT_FALSE(accepts({-1.0, 0.0, 0.0, 1.0}));
  EXPECT_FALSE(accepts({1.0, 0.5, 0.4, 1.0}));
  EXPECT_FALSE(accepts({1.0, 1.1, 1.1, 1.0}));
  EXPECT_FALSE(accepts({1.0, kNaN, kNaN, 1.0}));
  EXPECT_FALSE(accepts({kInf, 0.0, 0.0, 1.0}));
}

TEST(Stamps, RoundTripToANanosecondAndCarryIntoTheNextSecond) {
  for (const double t : {0.0, 1.25, 12345.678901234, 1.7e9 + 0.123456}) {
    EXPECT_NEAR(seconds(to_time(t)), t, 2.5e-7) << t;
    EXPECT_LT(to_time(t).nanosec(), 1'000'000'000u);
  }
  const auto carried = to_time(2.9999999999);
  EXPECT_EQ(carried.sec(), 3);
  EXPECT_EQ(carried.nanosec(), 0u);
}

TEST(Stamps, ConvertedTwiceAreTheSame) {
  const double once = seconds(to_time(1.7e9 + 0.1));
  EXPECT_EQ(seconds(to_time(once)), once);
}

}  // namespace
}  // namespace foretrack
