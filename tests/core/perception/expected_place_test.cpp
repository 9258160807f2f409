// SPDX-License-Identifier: Apache-2.0
#include "core/perception/expected_place.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

const PerceptionParams kPlaceParams;

/// A person who walks to the left before a hovering vehicle, last seen at 2 s.
struct Seen {
  PerceptionState state;
  VehicleHistory history;
  CameraModel camera;

  static Vec3 person_at(double time_s) { return {3.0, 1.0 * time_s - 2.0, 1.2}; }
  explicit Seen(double until_s = 6.0) {
    for (double t = 0.0; t < until_s; t += 0.05) {
      VehicleState v;
      v.stamp_s = t;
      v.position_enu_m = {0.0, 0.0, 1.5};
      history.add(v);
    }
    for (int k = 0; k <= 60; ++k) see(person_at(k / 30.0), k / 30.0);
  }
  void see(const Vec3& place, double stamp_s) {
    TargetObservation o;
    o.kind = TargetObservation::Kind::kPosition;
    o.stamp_s = stamp_s;
    o.position_enu_m = place;
    o.covariance_m2 = 1e-4 * Mat3::Identity();
    perceive(state, o, history, kPlaceParams);
  }
  std::optional<ExpectedPlace> at(double stamp_s) const {
    return expected_place(state, history, camera, stamp_s, kPlaceParams);
  }
};

TEST(ExpectedPlace, IsWhereThePersonWillBeInTheImageOfThatTime) {
  const Seen seen;
  for (const double stamp_s : {2.0, 2.1, 2.3}) {
    const auto place = seen.at(stamp_s);
    ASSERT_TRUE(place);
    const Vec3 p = Seen::person_at(stamp_s) - Vec3(0.0, 0.0, 1.5);
    const CameraModel& c = seen.camera;
    EXPECT_NEAR(place->torso_px.x(), c.cx_px - c.fx_px * p.y() / p.x(), 2.0);
    EXPECT_NEAR(place->torso_px.y(), c.cy_px - c.fy_px * p.z() / p.x(), 2.0);
    EXPECT_NEAR(place->body_px, c.fx_px * kPlaceParams.target_height_m / p.x(), 1.0);
    EXPECT_FALSE(place->refused);
  }
}

TEST(ExpectedPlace, TheGateIsThreeSigmasAndHalfABodyAndGrows) {
  const Seen seen;
  double before_px = 0.0;
  for (const double stamp_s : {2.0, 2.5, 3.0}) {
    const auto place = seen.at(stamp_s);
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->gate_px, 3.0 * place->sigma_px + 0.5 * seen.camera.fx_px / 3.0, 1.0);
    EXPECT_GT(place->gate_px, before_px);
    before_px = place->gate_px;
  }
}

TEST(ExpectedPlace, AMeasurementThatTheFilterRefusedIsSaid) {
  Seen seen;
  seen.see({3.0, 3.0, 1.2}, 2.03);
  ASSERT_TRUE(seen.at(2.06));
  EXPECT_TRUE(seen.at(2.06)->refused);
  seen.see(Seen::person_at(2.07), 2.07);
  EXPECT_FALSE(seen.at(2.1)->refused);
}

TEST(ExpectedPlace, BehindTheCameraItIsFarOutsideTheImageAndHasNoGate) {
  Seen seen(4.0);
  VehicleState turned;
  turned.stamp_s = 4.1;
  turned.position_enu_m = {0.0, 0.0, 1.5};
  turned.q_world_body = Quat(Eigen::AngleAxisd(kPi, Vec3::UnitZ()));
  seen.history.add(turned);
  seen.see(Seen::person_at(4.0), 4.0);
  seen.see(Seen::person_at(4.05), 4.05);
  const auto place = seen.at(4.1);
  ASSERT_TRUE(place);
  EXPECT_LT(place->torso_px.x(), -1e5);
  EXPECT_EQ(place->gate_px, 0.0);
}

TEST(ExpectedPlace, NobodyIsExpectedBeforeAnybodyWasSeenOrOnceTheyAreLost) {
  const Seen seen;
  EXPECT_FALSE(expected_place(PerceptionState(), seen.history, seen.camera, 1.0, kPlaceParams));
  EXPECT_TRUE(seen.at(2.0 + 0.9 * kPlaceParams.lost_age_s));
  EXPECT_FALSE(seen.at(2.1 + kPlaceParams.lost_age_s));
}

TEST(ExpectedPlace, WithoutTheVehiclesPoseThereIsNone) {
  const Seen seen;
  EXPECT_FALSE(expected_place(seen.state, VehicleHistory(), seen.camera, 2.0, kPlaceParams));
}

}  // namespace
}  // namespace foretrack
