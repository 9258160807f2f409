// SPDX-License-Identifier: Apache-2.0
#include "core/perception/target_filter.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

const PerceptionParams kFilterParams;

Mat6 random_covariance(Random& random) {
  Mat6 root;
  for (double& x : root.reshaped()) x = 0.1 * random.normal();
  return root * root.transpose() + 1e-3 * Mat6::Identity();
}

TargetEstimate walking(Random& random) {
  TargetEstimate e;
  e.started = true;
  e.stamp_s = e.accepted_s = 5.0;
  e.mean << 1.0, -2.0, 1.1, 1.4, 0.3, 0.2;
  e.covariance = random_covariance(random);
  e.yaw_rad = 0.5;
  e.yaw_variance_rad2 = 0.02;
  return e;
}

TorsoMeasurement measured(const Vec3& position, double stamp_s) {
  TorsoMeasurement m;
  m.stamp_s = stamp_s;
  m.position_enu_m = position;
  m.covariance_m2 = Vec3(4e-4, 9e-4, 1e-4).asDiagonal();
  return m;
}

TEST(PredictEstimate, KeepsTheHorizontalVelocityAndForgetsTheVerticalOne) {
  Random random(1);
  const TargetEstimate e = walking(random);
  for (const double dt_s : {0.0, 0.03, 0.5, 3.0}) {
    const TargetEstimate later = predict_estimate(e, e.stamp_s + dt_s, kFilterParams);
    EXPECT_NEAR(later.mean[0], e.mean[0] + dt_s * e.mean[3], 1e-12);
    EXPECT_NEAR(later.mean[1], e.mean[1] + dt_s * e.mean[4], 1e-12);
    // Its speed falls by 1/e in each time constant; its height is the integral of that.
    double height_m = e.mean[2], speed_m_s = e.mean[5];
    const int steps = 20000;
    for (int k = 0; k < steps; ++k) {
      const double half = speed_m_s * (1.0 - 0.5 * dt_s / steps / kFilterParams.vertical_damping_s);
      height_m += half * dt_s / steps;
      speed_m_s -= half / kFilterParams.vertical_damping_s * dt_s / steps;
    }
    EXPECT_NEAR(later.mean[2], height_m, 1e-6);
    EXPECT_NEAR(later.mean[5], speed_m_s, 1e-6);
  }
}

// The covariance of a point whose acceleration is white noise, by small steps of its differential
// equation.
TEST(PredictEstimate, HorizontalCovarianceGrowsAsUnderWhiteAcceleration) {
  Random random(2);
  const TargetEstimate e = walking(random);
  const double dt_s = 0.7;
  const TargetEstimate later = predict_estimate(e, e.stamp_s + dt_s, kFilterParams);
  const Eigen::Array4i kept(0, 1, 3, 4);
  Eigen::Matrix4d p = e.covariance(kept, kept), f = Eigen::Matrix4d::Zero();
  f(0, 2) = f(1, 3) = 1.0;
  const Eigen::Vector4d noise(0, 0, kFilterParams.steady_density_m2_s3,
                              kFilterParams.steady_density_m2_s3);
  const int steps = 20000;
  for (int k = 0; k < steps; ++k) {
    const Eigen::Matrix4d rate = f * p + p * f.transpose();
    p += dt_s / steps * rate;
    p.diagonal() += dt_s / steps * noise;
  }
  EXPECT_LT((later.covariance(kept, kept) - p).cwiseAbs().maxCoeff(), 2e-4);
  EXPECT_NEAR(later.yaw_variance_rad2,
              e.yaw_variance_rad2 + kFilterParams.yaw_density_rad2_s * dt_s, 1e-12);
}

TEST(PredictEstimate, TwoStepsAreOneOverTheGround) {
  Random random(3);
  const TargetEstimate e = walking(random);
  const TargetEstimate once = predict_estimate(e, 6.0, kFilterParams);
  const TargetEstimate twice =
      predict_estimate(predict_estimate(e, 5.3, kFilterParams), 6.0, kFilterParams);
  const Eigen::Array4i kept(0, 1, 3, 4);
  EXPECT_LT((once.covariance(kept, kept) - twice.covariance(kept, kept)).norm(), 1e-11);
  EXPECT_LT((once.mean - twice.mean).norm(), 1e-12);
}

// The density that a prediction over dt added to a covariance of zero.
double density_of(TargetEstimate e) {
  e.covariance.setZero();
  return predict_estimate(e, e.stamp_s + 1.0, kFilterParams).covariance(3, 3);
}

TEST(PredictEstimate, ProcessNoiseGrowsWithInnovationsThatPointTheSameWay) {
  Random random(4);
  TargetEstimate e = walking(random);
  EXPECT_DOUBLE_EQ(density_of(e), kFilterParams.steady_density_m2_s3);
  e.manoeuvre = Vec2(0.6, 0.8) * kFilterParams.manoeuvre_level;
  EXPECT_NEAR(density_of(e), kFilterParams.steady_density_m2_s3, 1e-12);
  e.manoeuvre *= 1.2;
  EXPECT_GT(density_of(e), kFilterParams.steady_density_m2_s3);
  EXPECT_LT(density_of(e), kFilterParams.manoeuvre_density_m2_s3);
  e.manoeuvre *= 10.0;
  EXPECT_DOUBLE_EQ(density_of(e), kFilterParams.manoeuvre_density_m2_s3);
}

TEST(PredictEstimate, DoubtfulMeasurementsThatWereRefusedAreNoManoeuvre) {
  Random random(5);
  TargetEstimate e = walking(random);
  e.manoeuvre = Vec2(10.0, 0.0);
  e.gated_in_a_row = 3;
  EXPECT_DOUBLE_EQ(density_of(e), kFilterParams.manoeuvre_density_m2_s3);
  e.gated_doubtful = true;
  EXPECT_DOUBLE_EQ(density_of(e), kFilterParams.doubt_density_m2_s3);
}

// The posterior of two independent Gaussians, in information form.
TEST(Advance, CorrectsAsBayesRuleSays) {
  Random random(6);
  for (int round = 0; round < 50; ++round) {
    const TargetEstimate e = walking(random);
    const TargetEstimate prior = predict_estimate(e, 5.05, kFilterParams);
    TorsoMeasurement m = measured(prior.mean.head<3>(), 5.05);
    for (double& x : m.position_enu_m) x += 0.03 * random.normal();
    const TargetEstimate posterior = advance(e, m, kFilterParams);
    ASSERT_EQ(posterior.verdict, FilterVerdict::kAccepted);
    Mat6 information = prior.covariance.inverse();
    Vec6 weighted = information * prior.mean;
    information.topLeftCorner<3, 3>() += m.covariance_m2.inverse();
    weighted.head<3>() += m.covariance_m2.inverse() * m.position_enu_m;
    const Mat6 covariance = information.inverse();
    EXPECT_LT((posterior.covariance - covariance).norm(), 1e-6 * covariance.norm());
    EXPECT_LT((posterior.mean - covariance * weighted).norm(), 1e-6);
    EXPECT_EQ(posterior.accepted_s, 5.05);
    EXPECT_LT((posterior.covariance - posterior.covariance.transpose()).norm(), 1e-12);
  }
}

TEST(Advance, TheGateIsTheMahalanobisDistance) {
  Random random(7);
  const TargetEstimate e = walking(random);
  const TargetEstimate prior = predict_estimate(e, 5.05, kFilterParams);
  const Mat3 spread =
      prior.covariance.topLeftCorner<3, 3>() + measured(Vec3::Zero(), 0.0).covariance_m2;
  const Vec3 direction(0.5, -0.7, 0.1);
  const double per_m = std::sqrt(direction.dot(spread.inverse() * direction));
  for (const double share : {0.99, 1.01}) {
    const Vec3 away = share * kFilterParams.gate_mahalanobis / per_m * direction;
    const TargetEstimate after =
        advance(e, measured(prior.mean.head<3>() + away, 5.05), kFilterParams);
    EXPECT_NEAR(after.mahalanobis, share * kFilterParams.gate_mahalanobis, 1e-9);
    EXPECT_EQ(after.verdict, share < 1.0 ? FilterVerdict::kAccepted : FilterVerdict::kGated);
    if (share > 1.0) {
      EXPECT_EQ(after.mean, prior.mean) << "what is refused moves nothing";
      EXPECT_EQ(after.accepted_s, e.accepted_s);
    }
  }
}

TEST(Advance, RefusedMeasurementsThatAgreeStartTheTrackAnewAndOthersDoNot) {
  Random random(8);
  const auto verdicts = [&](double scatter_m) {
    TargetEstimate e = walking(random);
    int started = 0;
    for (int k = 1; k <= kFilterParams.reinitialise_after; ++k) {
      const Vec3 place(8.0 + (k % 2) * scatter_m, 5.0, 1.1);
      e = advance(e, measured(place, 5.0 + 0.03 * k), kFilterParams);
      started += e.verdict == FilterVerdict::kStarted;
    }
    return started;
  };
  EXPECT_EQ(verdicts(0.9 * kFilterParams.reinitialise_radius_m), 1);
  EXPECT_EQ(verdicts(1.1 * kFilterParams.reinitialise_radius_m), 0);
}

TEST(Advance, StartsWithoutAVelocityAndWithTheMeasurementsNoise) {
  TorsoMeasurement m = measured({1.0, 2.0, 1.2}, 3.0);
  m.yaw_rad = 1.0;
  const TargetEstimate e = advance({}, m, kFilterParams);
  EXPECT_EQ(e.verdict, FilterVerdict::kStarted);
  EXPECT_EQ(Vec3(e.mean.head<3>()), m.position_enu_m);
  EXPECT_EQ(Vec3(e.mean.tail<3>()), Vec3(0.0, 0.0, 0.0));
  EXPECT_EQ(Mat3(e.covariance.topLeftCorner<3, 3>()), m.covariance_m2);
  EXPECT_DOUBLE_EQ(std::sqrt(e.covariance(3, 3)), kFilterParams.initial_speed_sigma_m_s);
  EXPECT_EQ(e.yaw_rad, 1.0);
}

TEST(Advance, StartsAnewOnceTheTargetIsLost) {
  Random random(9);
  const TargetEstimate e = walking(random);
  const auto verdict = [&](double after_s) {
    const double stamp_s = e.accepted_s + after_s;
    const Vec3 place = predict_estimate(e, stamp_s, kFilterParams).mean.head<3>();
    return advance(e, measured(place, stamp_s), kFilterParams).verdict;
  };
  EXPECT_EQ(verdict(kFilterParams.lost_age_s - 0.01), FilterVerdict::kAccepted);
  EXPECT_EQ(verdict(kFilterParams.lost_age_s + 0.01), FilterVerdict::kStarted);
}

struct Yawing {
  TargetEstimate e;
  Yawing() {
    Random random(10);
    e = walking(random);
  }
  void see(double yaw_rad, double variance_rad2 = 0.02) {
    const double stamp_s = e.stamp_s + 1e-9;
    TorsoMeasurement m =
        measured(predict_estimate(e, stamp_s, kFilterParams).mean.head<3>(), stamp_s);
    m.yaw_rad = yaw_rad;
    m.yaw_variance_rad2 = variance_rad2;
    e = advance(e, m, kFilterParams);
  }
};

TEST(Advance, YawsOfEqualNoiseAreAveragedTheShortWayRound) {
  Yawing y;
  y.e.yaw_rad = kPi - 0.1;
  y.see(-kPi + 0.3);
  EXPECT_NEAR(y.e.yaw_rad, -kPi + 0.1, 1e-6);
  EXPECT_NEAR(y.e.yaw_variance_rad2, 0.01, 1e-6);
}

TEST(Advance, AFlippedYawIsIgnoredUntilItStays) {
  Yawing y;
  for (int k = 1; k < kFilterParams.reinitialise_after; ++k) {
    y.see(0.5 + kPi);
    EXPECT_NEAR(y.e.yaw_rad, 0.5, 1e-9) << k;
  }
  y.see(0.5 + kPi);
  EXPECT_NEAR(wrap_angle(y.e.yaw_rad - 0.5 - kPi), 0.0, 1e-9);
}

TEST(Advance, TheFirstYawIsTakenAndAMissingOneChangesNothing) {
  Yawing y;
  y.e.yaw_rad = std::numeric_limits<double>::quiet_NaN();
  y.see(2.0, 0.05);
  EXPECT_EQ(y.e.yaw_rad, 2.0);
  EXPECT_EQ(y.e.yaw_variance_rad2, 0.05);
  y.see(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(y.e.yaw_rad, 2.0);
}

TEST(TargetState, SaysWhatTheEstimateDoes) {
  Random random(11);
  TargetEstimate e = walking(random);
  e.accepted_s = 4.5;
  const TargetState target = target_state(e);
  EXPECT_EQ(target.stamp_s, 5.0);
  EXPECT_EQ(target.position_enu_m, Vec3(1.0, -2.0, 1.1));
  EXPECT_EQ(target.velocity_enu_m_s, Vec3(1.4, 0.3, 0.2));
  EXPECT_EQ(target.covariance, e.covariance);
  EXPECT_EQ(target.body_yaw_rad, 0.5);
  EXPECT_EQ(target.last_measurement_s, 4.5);
}

}  // namespace
}  // namespace foretrack
