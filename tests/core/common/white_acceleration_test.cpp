// SPDX-License-Identifier: Apache-2.0
#include "core/common/white_acceleration.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

using Mat4 = Eigen::Matrix4d;

Mat4 grown(Mat4 covariance, const Vec2& density_m2_s3, double dt_s) {
  Mat4 transition = Mat4::Identity();
  transition.topRightCorner<2, 2>() = dt_s * Mat2::Identity();
  covariance = (transition * covariance * transition.transpose()).eval();
  add_white_acceleration<2>(covariance, density_m2_s3, dt_s);
  return covariance;
}

TEST(WhiteAcceleration, OneLongStepGrowsAsMuchAsManyShortOnes) {
  const Vec2 density(0.7, 2.0);
  Mat4 often = 0.1 * Mat4::Identity();
  const Mat4 once = grown(often, density, 0.8);
  for (int i = 0; i < 16; ++i) often = grown(often, density, 0.05);
  EXPECT_LT((often - once).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(WhiteAcceleration, VelocityVariesByDensityTimesTimeAndAxesAreApart) {
  Mat4 covariance = Mat4::Zero();
  add_white_acceleration<2>(covariance, Vec2(3.0, 0.0), 0.5);
  EXPECT_DOUBLE_EQ(covariance(2, 2), 1.5);
  EXPECT_DOUBLE_EQ(covariance(0, 0), 3.0 * 0.125 / 3.0);
  EXPECT_DOUBLE_EQ(covariance(0, 2), covariance(2, 0));
  EXPECT_EQ(covariance.row(1).norm() + covariance.row(3).norm(), 0.0);
  EXPECT_EQ(covariance(0, 1), 0.0);
}

}  // namespace
}  // namespace foretrack
