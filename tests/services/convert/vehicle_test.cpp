// SPDX-License-Identifier: Apache-2.0
#include "services/convert/vehicle.hpp"

#include "convert_test_support.hpp"

namespace foretrack {
namespace {

using testing::kInf;
using testing::kNaN;
using M = nav_msgs::msg::Odometry;

VehicleState state() {
  VehicleState s;
  s.stamp_s = 1.5;
  s.position_enu_m = {1, 2, 3};
  s.velocity_enu_m_s = {0.5, -1.0, 0.25};
  s.q_world_body = Quat(Eigen::AngleAxisd(kPi / 2.0, Vec3::UnitZ()));
  s.angular_velocity_body_rad_s = {0.1, 0.2, 0.3};
  return s;
}

M message() {
  M msg;
  to_idl(state(), msg);
  return msg;
}

TEST(OdometryMessage, RoundTrips) {
  const auto out = from_idl(message());
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->stamp_s, state().stamp_s);
  EXPECT_EQ(out->position_enu_m, state().position_enu_m);
  EXPECT_TRUE(out->velocity_enu_m_s.isApprox(state().velocity_enu_m_s, 1e-12));
  EXPECT_LT(out->q_world_body.angularDistance(state().q_world_body), 1e-12);
  EXPECT_EQ(out->angular_velocity_body_rad_s, state().angular_velocity_body_rad_s);
}

TEST(OdometryMessage, TwistIsInTheBodyFrame) {
  // Facing north, flying 0.5 m/s east and 1 m/s south: backwards, and to the right.
  const auto msg = message();
  EXPECT_NEAR(msg.twist().twist().linear().x(), -1.0, 1e-12);
  EXPECT_NEAR(msg.twist().twist().linear().y(), -0.5, 1e-12);
}

TEST(OdometryMessage, AcceptsAPrefixedBodyFrame) {
  M msg = message();
  msg.child_frame_id("uav1/base_link");
  EXPECT_TRUE(from_idl(msg));
}

TEST(OdometryMessage, RefusesEachBadField) {
  testing::expect_each_refused<M>(
      message(),
      testing::header_faults<M>() +
          std::vector<testing::PlantedFault<M>>{
              {"child_frame_id", [](M& m) { m.child_frame_id("camera"); }},
              {"pose.position", [](M& m) { m.pose().pose().position().z(kNaN); }},
              {"pose.orientation", [](M& m) { m.pose().pose().orientation() = {}; }},
              {"pose.orientation", [](M& m) { m.pose().pose().orientation().x(kNaN); }},
              {"pose.orientation", [](M& m) { m.pose().pose().orientation().w(2.0); }},
              {"twist.linear", [](M& m) { m.twist().twist().linear().x(kInf); }},
              {"twist.angular", [](M& m) { m.twist().twist().angular().y(1e4); }},
          },
      [](const M& m) { return from_idl(m); });
}

TEST(OdometryMessage, OfAnotherFrameIsBroughtIntoTheMap) {
  M msg = message();
  msg.header().frame_id("odom");
  OdometryFrames frames;
  frames.is_map = true;
  EXPECT_EQ(from_idl(msg, frames)->position_enu_m, Vec3(1, 2, 3));
  frames.is_map = false;
  frames.in_map = [](const std::string& frame, double stamp_s, std::string& why) {
    why = "no transform of 'odom' is known";
    Pose pose = Pose::Identity();
    pose.translation() = Vec3(10, 0, 0);
    pose.linear() = Eigen::AngleAxisd(kPi / 2.0, Vec3::UnitZ()).toRotationMatrix();
    return frame == "odom" && stamp_s == 1.5 ? std::optional(pose) : std::nullopt;
  };
  const auto out = from_idl(msg, frames);
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_TRUE(out->position_enu_m.isApprox(Vec3(8, 1, 3), 1e-12));
  EXPECT_TRUE(out->velocity_enu_m_s.isApprox(Vec3(1.0, 0.5, 0.25), 1e-12));
  EXPECT_NEAR(out->yaw_rad(), kPi, 1e-9);
  msg.header().frame_id("world");
  const auto refused = from_idl(msg, frames);
  EXPECT_EQ(refused.fault().field, "header.frame_id");
  EXPECT_EQ(refused.fault().text,
            "header.frame_id is 'world', expected 'map', a transform map -> world (no transform of "
            "'odom' is known), or --odometry-is-map");
}

TEST(OdometryMessage, TheBodyMayHaveAnotherName) {
  M msg = message();
  msg.child_frame_id("drone/fcu");
  EXPECT_EQ(from_idl(msg).fault().text, "child_frame_id is 'drone/fcu', expected 'base_link'");
  OdometryFrames frames;
  frames.body = "fcu";
  EXPECT_TRUE(from_idl(msg, frames));
}

}  // namespace
}  // namespace foretrack
