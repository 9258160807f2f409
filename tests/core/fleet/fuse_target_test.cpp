// SPDX-License-Identifier: Apache-2.0
#include "core/fleet/fuse_target.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

FleetPerson person_at(const Vec3& place, double sigma_x_m, double sigma_y_m) {
  FleetPerson p;
  p.position_enu_m = place;
  p.covariance.diagonal() << sigma_x_m * sigma_x_m, sigma_y_m * sigma_y_m, 0.01, 0.1, 0.1, 0.01;
  return p;
}

TEST(AtTime, GoesOnWithItsVelocityLessAndLessCertain) {
  FleetPerson p = person_at({0, 0, 1}, 0.1, 0.1);
  p.velocity_enu_m_s = {1, 2, 0};
  const FleetPerson later = at_time(p, 5.0, 6.0);
  EXPECT_TRUE(later.position_enu_m.isApprox(Vec3(1, 2, 1)));
  EXPECT_GT(later.covariance(0, 0), p.covariance(0, 0) + p.covariance(3, 3) - 1e-9);
  EXPECT_TRUE(at_time(p, 5.0, 4.0).position_enu_m.isApprox(p.position_enu_m)) << "never back";
}

TEST(Intersect, TakesOfEachWhatItKnowsBest) {
  const FleetPerson a = person_at({0, 0, 1}, 0.1, 1.0), b = person_at({1, 1, 1}, 1.0, 0.1);
  const FleetPerson both = intersect(a, b);
  EXPECT_NEAR(both.position_enu_m.x(), 0.0, 0.1);
  EXPECT_NEAR(both.position_enu_m.y(), 1.0, 0.1);
}

TEST(Intersect, OfTheSameWordTwiceKnowsNothingMore) {
  const FleetPerson a = person_at({3, 2, 1}, 0.2, 0.3);
  const FleetPerson both = intersect(a, a);
  EXPECT_TRUE(both.position_enu_m.isApprox(a.position_enu_m));
  EXPECT_TRUE(both.covariance.isApprox(a.covariance, 1e-6));
}

// Whatever the errors have in common, the result is not surer than it is right.
TEST(Intersect, IsConsistentWhateverTheCorrelation) {
  Random random(3);
  for (const double common : {0.0, 0.5, 0.95, 1.0}) {
    double sum2 = 0.0, told2 = 0.0;
    for (int i = 0; i < 2000; ++i) {
      const double shared = random.normal(), own = std::sqrt(1.0 - common * common);
      const FleetPerson a = person_at({common * shared + own * random.normal(), 0, 1}, 1.0, 1.0);
      const FleetPerson b =
          person_at({1.5 * (common * shared + own * random.normal()), 0, 1}, 1.5, 1.0);
      const FleetPerson both = intersect(a, b);
      sum2 += both.position_enu_m.x() * both.position_enu_m.x();
      told2 += both.covariance(0, 0);
    }
    EXPECT_LT(sum2, 1.1 * told2) << "correlation " << common;
  }
}

TEST(Apart2, CountsInSigmas) {
  EXPECT_NEAR(apart2(person_at({0, 0, 1}, 0.3, 0.3), person_at({1, 0, 5}, 0.4, 0.3)), 4.0, 1e-6);
}

}  // namespace
}  // namespace foretrack
