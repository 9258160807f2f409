// SPDX-License-Identifier: Apache-2.0
#include "services/convert/target.hpp"

#include "convert_test_support.hpp"

namespace foretrack {
namespace {

using testing::kInf;
using testing::kNaN;
using Observation = foretrack_msgs::msg::TargetObservation;
using State = foretrack_msgs::msg::TargetState;

TargetObservation landmarks() {
  TargetObservation o;
  o.stamp_s = 12.5;
  o.camera = CameraModel::from_fov(640, 480, rad(90), rad(75));
  for (int i = 0; i < kLandmarkCount; ++i) {
    o.landmarks[i].image_px = {10.0 * i, 5.0 * i};
    o.landmarks[i].body_m = {0.01 * i, -0.02 * i, 0.005 * i};
    o.landmarks[i].visibility = i / 64.0;
  }
  return o;
}

TargetObservation position() {
  TargetObservation o;
  o.stamp_s = 3.0;
  o.kind = TargetObservation::Kind::kPosition;
  o.position_enu_m = {1, -2, 3};
  o.covariance_m2 << 1, 0.1, 0.2, 0.1, 2, 0.3, 0.2, 0.3, 3;
  o.body_yaw_rad = 0.7;
  o.body_yaw_variance_rad2 = 0.02;
  return o;
}

TargetState tracked() {
  TargetState s;
  s.stamp_s = 20.0;
  s.status = TrackStatus::kCoasting;
  s.position_enu_m = {4, 5, 1};
  s.velocity_enu_m_s = {1, -1, 0};
  s.covariance = Mat6::Identity() * 0.5;
  s.covariance(0, 3) = s.covariance(3, 0) = 0.25;
  s.body_yaw_rad = -1.5;
  s.body_yaw_variance_rad2 = 0.1;
  s.last_measurement_s = 19.5;
  return s;
}

template <class Msg, class Core>
Msg message(const Core& core) {
  Msg msg;
  to_idl(core, msg);
  return msg;
}

TEST(TargetObservationMessage, KeepsLandmarksAndCamera) {
  const TargetObservation in = landmarks();
  const auto out = from_idl(message<Observation>(in));
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->stamp_s, in.stamp_s);
  EXPECT_EQ(out->kind, in.kind);
  EXPECT_EQ(out->camera.width_px, in.camera.width_px);
  EXPECT_EQ(out->camera.fy_px, in.camera.fy_px);
  EXPECT_TRUE(out->camera.T_body_camera.isApprox(in.camera.T_body_camera, 1e-12));
  for (int i = 1; i < kLandmarkCount; ++i) {  // the first is not seen
    EXPECT_TRUE(out->landmarks[i].image_px.isApprox(in.landmarks[i].image_px, 1e-6)) << i;
    EXPECT_TRUE(out->landmarks[i].body_m.isApprox(in.landmarks[i].body_m, 1e-6)) << i;
    EXPECT_EQ(out->landmarks[i].visibility, in.landmarks[i].visibility) << i;
  }
}

TEST(TargetObservationMessage, KeepsPositionsAndUnknownYaws) {
  TargetObservation in = position();
  auto out = from_idl(message<Observation>(in));
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->position_enu_m, in.position_enu_m);
  EXPECT_EQ(out->covariance_m2, in.covariance_m2);
  EXPECT_EQ(out->body_yaw_rad, in.body_yaw_rad);
  EXPECT_EQ(out->body_yaw_variance_rad2, in.body_yaw_variance_rad2);
  in.body_yaw_rad = kNaN;
  out = from_idl(message<Observation>(in));
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_TRUE(std::isnan(out->body_yaw_rad));
}

TEST(TargetObservationMessage, AcceptsGarbageInLandmarksThatAreNotSeen) {
  Observation msg = message<Observation>(landmarks());
  msg.landmarks()[3].visibility(0.0f);
  msg.landmarks()[3].image_x_px(static_cast<float>(kNaN));
  const auto out = from_idl(msg);
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->landmarks[3].image_px, Vec2(0, 0));
}

TEST(TargetObservationMessage, NobodySeenIsNoFaultButNoObservation) {
  Observation msg = message<Observation>(position());
  EXPECT_FALSE(sees_nobody(msg));
  msg.kind(foretrack_msgs::msg::TargetObservation_Constants::KIND_NONE);
  EXPECT_TRUE(sees_nobody(msg));
  EXPECT_FALSE(from_idl(msg));
}

TEST(TargetObservationMessage, RefusesBadLandmarkRows) {
  using M = Observation;
  const float nan = static_cast<float>(kNaN);
  testing::expect_each_refused<M>(
      message<M>(landmarks()),
      testing::header_faults<M>() +
          std::vector<testing::PlantedFault<M>>{
              {"kind", [](M& m) { m.kind(2); }},
              {"landmarks", [](M& m) { m.landmarks().resize(32); }},
              {"landmarks", [](M& m) { m.landmarks().resize(1000); }},
              {"landmarks", [](M& m) { m.landmarks().clear(); }},
              {"landmarks.visibility", [](M& m) { m.landmarks()[5].visibility(1.5f); }},
              {"landmarks.visibility", [=](M& m) { m.landmarks()[5].visibility(nan); }},
              {"landmarks.image_x_px", [=](M& m) { m.landmarks()[5].image_x_px(nan); }},
              {"landmarks.image_y_px", [](M& m) { m.landmarks()[5].image_y_px(1e30f); }},
              {"landmarks.body_x_m", [](M& m) { m.landmarks()[5].body_x_m(11.0f); }},
              {"landmarks.body_z_m", [=](M& m) { m.landmarks()[32].body_z_m(nan); }},
              {"camera.width_px", [](M& m) { m.camera().width_px(0); }},
              {"camera.height_px", [](M& m) { m.camera().height_px(4'000'000'000u); }},
              {"camera.fx_px", [](M& m) { m.camera().fx_px(0.0); }},
              {"camera.fy_px", [](M& m) { m.camera().fy_px(kInf); }},
              {"camera.cx_px", [](M& m) { m.camera().cx_px(kNaN); }},
              {"camera.pose_body.orientation",
               [](M& m) { m.camera().pose_body().orientation() = {}; }},
              {"camera.pose_body.position",
               [](M& m) { m.camera().pose_body().position().y(kNaN); }},
          },
      [](const M& m) { return from_idl(m); });
}

TEST(TargetObservationMessage, RefusesBadPositions) {
  using M = Observation;
  testing::expect_each_refused<M>(
      message<M>(position()),
      {
          {"position_m", [](M& m) { m.position_m()[2] = kNaN; }},
          {"position_m", [](M& m) { m.position_m()[0] = 1e9; }},
          {"position_covariance_m2", [](M& m) { m.position_covariance_m2()[0] = -1.0; }},
          {"position_covariance_m2", [](M& m) { m.position_covariance_m2()[1] = 0.9; }},
          {"body_yaw_rad", [](M& m) { m.body_yaw_rad(kNaN); }},
          {"body_yaw_variance_rad2", [](M& m) { m.body_yaw_variance_rad2(kInf); }},
      },
      [](const M& m) { return from_idl(m); });
}

TEST(TargetStateMessage, RoundTrips) {
  const TargetState in = tracked();
  const auto out = from_idl(message<State>(in));
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->stamp_s, in.stamp_s);
  EXPECT_EQ(out->status, in.status);
  EXPECT_EQ(out->position_enu_m, in.position_enu_m);
  EXPECT_EQ(out->velocity_enu_m_s, in.velocity_enu_m_s);
  EXPECT_EQ(out->covariance, in.covariance);
  EXPECT_EQ(out->body_yaw_rad, in.body_yaw_rad);
  EXPECT_EQ(out->last_measurement_s, in.last_measurement_s);
}

TEST(TargetStateMessage, ReadsNothingButTheStatusOfATargetThatWasNeverSeen) {
  TargetState in;
  in.stamp_s = 5.0;
  State msg = message<State>(in);
  msg.position_m()[0] = kNaN;
  const auto out = from_idl(msg);
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->status, TrackStatus::kNone);
  EXPECT_EQ(out->position_enu_m, Vec3(0, 0, 0));
}

TEST(TargetStateMessage, RefusesEachBadField) {
  using M = State;
  testing::expect_each_refused<M>(
      message<M>(tracked()),
      testing::header_faults<M>() +
          std::vector<testing::PlantedFault<M>>{
              {"status", [](M& m) { m.status(4); }},
              {"position_m", [](M& m) { m.position_m()[1] = kInf; }},
              {"velocity_mps", [](M& m) { m.velocity_mps()[1] = 1e6; }},
              {"covariance", [](M& m) { m.covariance()[35] = -0.1; }},
              {"covariance", [](M& m) { m.covariance()[3] = 0.2; }},
              {"last_measurement_age_s", [](M& m) { m.last_measurement_age_s(kNaN); }},
              {"body_yaw_rad", [](M& m) { m.body_yaw_rad(kInf); }},
          },
      [](const M& m) { return from_idl(m); });
}

}  // namespace
}  // namespace foretrack
