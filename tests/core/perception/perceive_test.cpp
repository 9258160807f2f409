// SPDX-License-Identifier: Apache-2.0
#include "core/perception/perceive.hpp"

#include <gtest/gtest.h>

#include "tests/core/perception/synthetic_person.hpp"
#include "tests/support/count_allocations.hpp"

namespace foretrack {
namespace {

using test::LandmarkNoise;
using test::observe;
using test::PersonState;
using test::torso_of;
using test::vehicle_at;
using test::Walk;

const PerceptionParams kPerceiveParams;
constexpr double kFrame_s = 1.0 / 30.0;

TargetObservation position_at(double stamp_s, const Vec3& position, double sigma_m = 0.03) {
  TargetObservation o;
  o.kind = TargetObservation::Kind::kPosition;
  o.stamp_s = stamp_s;
  o.position_enu_m = position;
  o.covariance_m2 = Mat3::Identity() * sigma_m * sigma_m;
  return o;
}

// A straight walk at 1 m/s.
Vec3 walked(double t_s) {
  return {t_s, 2.0, 1.2};
}

void walk_straight(PerceptionState& state, double from_s, double to_s) {
  for (double t = from_s; t < to_s; t += kFrame_s)
    perceive(state, position_at(t, walked(t)), VehicleHistory(), kPerceiveParams);
}

TEST(Perceive, UsesTheVehiclesPoseAtTheImagesStamp) {
  // The vehicle turns at 1 rad/s; its newest pose is 0.1 s after the image.
  PersonState person;
  person.hips_enu_m = {3.0, 0.0, 0.95};
  VehicleHistory history;
  VehicleState at_image;
  for (int k = 0; k <= 20; ++k) {
    VehicleState v;
    v.stamp_s = 0.02 * k + 0.003;
    v.position_enu_m = {0.5 * v.stamp_s, 0.0, 1.4};
    v.q_world_body = Quat(Eigen::AngleAxisd(v.stamp_s - 0.3, Vec3::UnitZ()));
    history.add(v);
  }
  at_image = *history.at(0.31);
  Random random(1);
  PerceptionState state;
  const auto o = observe(person, at_image, LandmarkNoise::none(), random);
  const auto result = perceive(state, o, history, kPerceiveParams);
  EXPECT_EQ(result.status, PerceptionStatus::kStarted);
  EXPECT_LT((result.target.position_enu_m - torso_of(person)).norm(), 1e-4);
}

TEST(Perceive, NamesEachReasonForRefusal) {
  PersonState person;
  person.hips_enu_m = {3.0, 0.0, 0.95};
  const VehicleState vehicle = vehicle_at(0.0, {0, 0, 1.4}, person.hips_enu_m);
  VehicleHistory history;
  history.add(vehicle);
  Random random(1);
  const auto good = observe(person, vehicle, LandmarkNoise(), random);
  const auto status_of = [&](const TargetObservation& o, const VehicleHistory& h) {
    PerceptionState state;
    const auto result = perceive(state, o, h, kPerceiveParams);
    EXPECT_EQ(result.target.status == TrackStatus::kNone,
              result.status != PerceptionStatus::kStarted);
    return result.status;
  };
  EXPECT_EQ(status_of(good, history), PerceptionStatus::kStarted);
  EXPECT_EQ(status_of(good, VehicleHistory()), PerceptionStatus::kNoVehiclePose);

  auto few = good;
  for (int k = 7; k < kLandmarkCount; ++k) few.landmarks[k].visibility = 0.2;
  EXPECT_EQ(status_of(few, history), PerceptionStatus::kTooFewLandmarks);

  auto scattered = good;
  for (auto& l : scattered.landmarks) l.image_px = {random.uniform(0, 640), random.uniform(0, 480)};
  EXPECT_EQ(status_of(scattered, history), PerceptionStatus::kPnpFailed);

  auto nan = good;
  for (auto& l : nan.landmarks) l.image_px.setConstant(std::nan(""));
  EXPECT_EQ(status_of(nan, history), PerceptionStatus::kTooFewLandmarks);

  EXPECT_EQ(status_of(position_at(std::nan(""), walked(0)), history), PerceptionStatus::kInvalid);
  EXPECT_EQ(status_of(position_at(0.0, Vec3::Constant(std::nan(""))), history),
            PerceptionStatus::kInvalid);
  auto negative = position_at(0.0, walked(0));
  negative.covariance_m2 *= -1.0;
  EXPECT_EQ(status_of(negative, history), PerceptionStatus::kInvalid);
  EXPECT_EQ(status_of(position_at(0.0, walked(0), 0.0), history), PerceptionStatus::kStarted);
}

TEST(Perceive, LateMeasurementLeavesTheSameEstimateAsOneInTime) {
  PerceptionState in_order, shuffled;
  std::vector<TargetObservation> observations;
  Random random(2);
  for (int k = 0; k < 20; ++k)
    observations.push_back(position_at(
        kFrame_s * k, walked(kFrame_s * k) + 0.03 * Vec3(random.normal(), random.normal(), 0)));
  for (const auto& o : observations) perceive(in_order, o, VehicleHistory(), kPerceiveParams);
  std::swap(observations[8], observations[9]);
  std::swap(observations[12], observations[17]);
  for (const auto& o : observations) perceive(shuffled, o, VehicleHistory(), kPerceiveParams);
  const auto a = coast(in_order, 1.0, kPerceiveParams), b = coast(shuffled, 1.0, kPerceiveParams);
  EXPECT_EQ(a.position_enu_m, b.position_enu_m);
  EXPECT_EQ(a.velocity_enu_m_s, b.velocity_enu_m_s);
  EXPECT_EQ(a.covariance, b.covariance);
}

TEST(Perceive, LateMeasurementsAreFilteredInWhenTheRingIsFull) {
  PerceptionState state;
  walk_straight(state, 0.0, 3.0);
  ASSERT_EQ(state.count, PerceptionState::kCapacity);
  const double newest_s = state.entries.back().measurement.stamp_s;
  const double late_s = newest_s - 4.5 * kFrame_s;
  const auto result =
      perceive(state, position_at(late_s, walked(late_s)), VehicleHistory(), kPerceiveParams);
  EXPECT_EQ(result.status, PerceptionStatus::kAccepted);
  EXPECT_EQ(state.entries.back().measurement.stamp_s, newest_s);
  for (int k = 1; k < state.count; ++k)
    EXPECT_LT(state.entries[k - 1].measurement.stamp_s, state.entries[k].measurement.stamp_s);
}

TEST(Perceive, RefusesDuplicatesAndWhatIsTooOld) {
  PerceptionState state;
  walk_straight(state, 0.0, 0.9);
  const auto before = coast(state, 1.0, kPerceiveParams);
  const double again_s = state.entries[state.count - 3].measurement.stamp_s;
  const auto status = [&](double stamp_s) {
    return perceive(state, position_at(stamp_s, walked(stamp_s)), VehicleHistory(), kPerceiveParams)
        .status;
  };
  EXPECT_EQ(status(again_s), PerceptionStatus::kDuplicate);
  EXPECT_EQ(status(state.entries[state.count - 1].measurement.stamp_s),
            PerceptionStatus::kDuplicate);
  EXPECT_EQ(status(0.25), PerceptionStatus::kTooOld);
  EXPECT_EQ(status(-5.0), PerceptionStatus::kTooOld);
  EXPECT_EQ(coast(state, 1.0, kPerceiveParams).position_enu_m, before.position_enu_m);
}

TEST(Perceive, OneWildMeasurementDoesNotMoveTheEstimate) {
  PerceptionState state;
  walk_straight(state, 0.0, 1.0);
  const auto result = perceive(state, position_at(1.01, walked(1.01) + Vec3(0, 2, 0)),
                               VehicleHistory(), kPerceiveParams);
  EXPECT_EQ(result.status, PerceptionStatus::kGated);
  EXPECT_GT(result.mahalanobis, kPerceiveParams.gate_mahalanobis);
  EXPECT_LT((result.target.position_enu_m - walked(1.01)).norm(), 0.02);
}

// Of what may be somebody else's, more of them.
TEST(Perceive, AgreeingMeasurementsElsewhereStartTheTrackAnew) {
  for (const bool doubtful : {false, true}) {
    PerceptionState state;
    walk_straight(state, 0.0, 1.0);
    const Vec3 elsewhere(1.0, 6.0, 1.2);
    const int enough =
        doubtful ? kPerceiveParams.reinitialise_doubtful_after : kPerceiveParams.reinitialise_after;
    for (int k = 1; k <= enough; ++k) {
      TargetObservation observation = position_at(1.0 + kFrame_s * k, elsewhere);
      observation.doubtful = doubtful;
      const auto result = perceive(state, observation, VehicleHistory(), kPerceiveParams);
      const bool last = k == enough;
      EXPECT_EQ(result.status, last ? PerceptionStatus::kStarted : PerceptionStatus::kGated) << k;
      EXPECT_EQ((result.target.position_enu_m - elsewhere).norm() < 0.1, last) << k;
    }
  }
}

TEST(Perceive, ScatteredWildMeasurementsNeverTakeTheTrack) {
  PerceptionState state;
  walk_straight(state, 0.0, 1.0);
  Random random(3);
  for (int k = 1; k <= 20; ++k) {
    const double t = 1.0 + kFrame_s * k;
    const Vec3 wild = walked(t) + 5.0 * direction_of(2.4 * k).homogeneous();
    perceive(state, position_at(t, wild), VehicleHistory(), kPerceiveParams);
  }
  EXPECT_LT((coast(state, 1.7, kPerceiveParams).position_enu_m - walked(1.7)).norm(), 0.2);
}

TEST(Coast, GoesFromTrackingToCoastingToLost) {
  PerceptionState state;
  EXPECT_EQ(coast(state, 0.0, kPerceiveParams).status, TrackStatus::kNone);
  walk_straight(state, 0.0, 2.0);
  const double last_s = coast(state, 0.0, kPerceiveParams).last_measurement_s;
  const auto status = [&](double age_s) {
    return coast(state, last_s + age_s, kPerceiveParams).status;
  };
  EXPECT_EQ(status(0.0), TrackStatus::kTracking);
  EXPECT_EQ(status(kPerceiveParams.tracking_age_s - 0.01), TrackStatus::kTracking);
  EXPECT_EQ(status(kPerceiveParams.tracking_age_s + 0.01), TrackStatus::kCoasting);
  EXPECT_EQ(status(kPerceiveParams.lost_age_s - 0.01), TrackStatus::kCoasting);
  EXPECT_EQ(status(kPerceiveParams.lost_age_s + 0.01), TrackStatus::kLost);
}

TEST(Coast, FollowsTheVelocityWithGrowingUncertainty) {
  PerceptionState state;
  walk_straight(state, 0.0, 2.0);
  double before = 0.0;
  for (double t = 2.0; t < 4.0; t += 0.1) {
    const auto target = coast(state, t, kPerceiveParams);
    EXPECT_EQ(target.stamp_s, t);
    EXPECT_LT((target.position_enu_m - walked(t)).norm(), 0.1);
    EXPECT_GT(target.covariance(0, 0), before);
    before = target.covariance(0, 0);
  }
  EXPECT_LT(coast(state, 4.0, kPerceiveParams).covariance(2, 2), before);  // height hardly changes
}

TEST(Coast, TrackStartsAnewAfterALoss) {
  PerceptionState state;
  walk_straight(state, 0.0, 1.0);
  const auto result =
      perceive(state, position_at(9.0, Vec3(-3, 0, 1.2)), VehicleHistory(), kPerceiveParams);
  EXPECT_EQ(result.status, PerceptionStatus::kStarted);
  EXPECT_EQ(result.target.status, TrackStatus::kTracking);
  EXPECT_EQ(result.target.position_enu_m, Vec3(-3, 0, 1.2));
}

TEST(Perceive, MissingMeasurementsAreBridged) {
  PerceptionState state;
  walk_straight(state, 0.0, 1.0);
  walk_straight(state, 1.8, 2.2);
  const auto target = coast(state, 2.2, kPerceiveParams);
  EXPECT_LT((target.velocity_enu_m_s - Vec3(1, 0, 0)).norm(), 0.05);
}

TEST(Perceive, BodyYawCrossesHalfATurnAndIgnoresFlips) {
  PerceptionState state;
  double yaw = 0.0;
  for (int k = 0; k < 90; ++k) {
    const double t = kFrame_s * k;
    yaw = 2.8 + 0.4 * t;
    auto o = position_at(t, walked(t));
    o.body_yaw_rad = wrap_angle(k % 10 == 9 ? yaw + kPi : yaw);
    o.body_yaw_variance_rad2 = 0.02;
    perceive(state, o, VehicleHistory(), kPerceiveParams);
  }
  EXPECT_NEAR(wrap_angle(coast(state, 3.0, kPerceiveParams).body_yaw_rad - yaw), 0.0, 0.1);
}

TEST(Perceive, SameInputGivesTheSameEstimate) {
  TargetState results[2];
  for (TargetState& result : results) {
    PerceptionState state;
    VehicleHistory history;
    Random random(5);
    for (int k = 0; k < 60; ++k) {
      const PersonState person = Walk().at(kFrame_s * k);
      const auto vehicle =
          vehicle_at(kFrame_s * k, person.hips_enu_m - Vec3(2, 0.3, -0.4), person.hips_enu_m);
      history.add(vehicle);
      result =
          perceive(state, observe(person, vehicle, {}, random), history, kPerceiveParams).target;
    }
  }
  EXPECT_EQ(results[0].position_enu_m, results[1].position_enu_m);
  EXPECT_EQ(results[0].covariance, results[1].covariance);
  EXPECT_EQ(results[0].body_yaw_rad, results[1].body_yaw_rad);
}

TEST(Perceive, AllocatesNothing) {
  PersonState person;
  person.hips_enu_m = {2.0, 0.0, 0.95};
  VehicleHistory history;
  Random random(6);
  PerceptionState state;
  for (int k = 0; k < 40; ++k) {
    const auto vehicle = vehicle_at(kFrame_s * k, {0, 0, 1.4}, person.hips_enu_m);
    history.add(vehicle);
    const auto o = observe(person, vehicle, {}, random);
    const long before = allocation_count();
    perceive(state, o, history, kPerceiveParams);
    coast(state, o.stamp_s + 0.1, kPerceiveParams);
    EXPECT_EQ(allocation_count(), before);
  }
}

}  // namespace
}  // namespace foretrack
