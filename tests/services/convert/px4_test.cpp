// SPDX-License-Identifier: Apache-2.0
#include "services/convert/px4.hpp"

#include "convert_test_support.hpp"

namespace foretrack {
namespace {

using testing::kInf;
using testing::kNaN;
namespace msg = px4_msgs::msg;

VehicleState state() {
  VehicleState s;
  s.stamp_s = 100.25;
  s.position_enu_m = {1, 2, 3};
  s.velocity_enu_m_s = {0.5, -1.0, 0.25};
  s.q_world_body = Quat(Eigen::AngleAxisd(0.7, Vec3(0.1, 0.2, 1.0).normalized()));
  s.angular_velocity_body_rad_s = {0.1, 0.2, 0.3};
  return s;
}

template <class Msg, class Core>
Msg message(const Core& core) {
  Msg m;
  to_idl(core, m);
  return m;
}

TEST(TrajectorySetpoint, IsInNedWithItsYawFromNorth) {
  Setpoint s;
  s.stamp_s = 2.0;
  s.position_enu_m = {1, 2, 3};
  s.velocity_enu_m_s = {4, 5, 6};
  s.yaw_rad = kPi / 2.0;  // north
  s.yaw_rate_rad_s = 0.5;
  const auto m = message<msg::TrajectorySetpoint>(s);
  EXPECT_EQ(m.timestamp(), 2'000'000u);
  EXPECT_THAT(m.position(), ::testing::ElementsAre(2.0f, 1.0f, -3.0f));
  EXPECT_THAT(m.velocity(), ::testing::ElementsAre(5.0f, 4.0f, -6.0f));
  EXPECT_NEAR(m.yaw(), 0.0, 1e-6);
  EXPECT_EQ(m.yawspeed(), -0.5f);
}

TEST(TrajectorySetpoint, RoundTripsWithUncontrolledFields) {
  Setpoint in;
  in.stamp_s = 3.5;
  in.position_enu_m = Vec3::Constant(kNaN);
  in.velocity_enu_m_s = {0.25, -0.5, 1.0};
  in.yaw_rad = 1.0;
  in.yaw_rate_rad_s = kNaN;
  const auto out = from_idl(message<msg::TrajectorySetpoint>(in));
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->stamp_s, 3.5);
  EXPECT_TRUE(out->position_enu_m.array().isNaN().all());
  EXPECT_EQ(out->velocity_enu_m_s, in.velocity_enu_m_s);
  EXPECT_NEAR(out->yaw_rad, 1.0, 1e-6);
  EXPECT_TRUE(std::isnan(out->yaw_rate_rad_s));
}

TEST(TrajectorySetpoint, RefusesInfinity) {
  using M = msg::TrajectorySetpoint;
  const auto inf = static_cast<float>(kInf);
  testing::expect_each_refused<M>(message<M>(Setpoint{}),
                                  {
                                      {"position", [=](M& m) { m.position()[1] = inf; }},
                                      {"velocity", [=](M& m) { m.velocity()[0] = -inf; }},
                                      {"acceleration", [=](M& m) { m.acceleration()[2] = inf; }},
                                      {"yaw", [=](M& m) { m.yawspeed(inf); }},
                                      {"timestamp", [](M& m) { m.timestamp(~0ull); }},
                                  },
                                  [](const M& m) { return from_idl(m); });
}

TEST(VehicleOdometry, RoundTrips) {
  const auto out = from_idl(message<msg::VehicleOdometry>(state()));
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->stamp_s, 100.25);
  EXPECT_TRUE(out->position_enu_m.isApprox(state().position_enu_m, 1e-6));
  EXPECT_TRUE(out->velocity_enu_m_s.isApprox(state().velocity_enu_m_s, 1e-6));
  EXPECT_LT(out->q_world_body.angularDistance(state().q_world_body), 1e-6);
  EXPECT_TRUE(out->angular_velocity_body_rad_s.isApprox(state().angular_velocity_body_rad_s, 1e-6));
}

TEST(VehicleOdometry, ReadsVelocitiesInTheBodyFrameToo) {
  auto m = message<msg::VehicleOdometry>(state());
  const Vec3 body_flu = state().q_world_body.conjugate() * state().velocity_enu_m_s;
  m.velocity_frame(msg::VehicleOdometry_Constants::VELOCITY_FRAME_BODY_FRD);
  m.velocity({static_cast<float>(body_flu.x()), static_cast<float>(-body_flu.y()),
              static_cast<float>(-body_flu.z())});
  const auto out = from_idl(m);
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_TRUE(out->velocity_enu_m_s.isApprox(state().velocity_enu_m_s, 1e-6));
}

TEST(VehicleOdometry, RefusesEachBadField) {
  using M = msg::VehicleOdometry;
  const auto nan = static_cast<float>(kNaN);
  testing::expect_each_refused<M>(
      message<M>(state()),
      {
          {"timestamp", [](M& m) { m.timestamp_sample(~0ull); }},
          {"pose_frame", [](M& m) { m.pose_frame(2); }},
          {"velocity_frame", [](M& m) { m.velocity_frame(0); }},
          {"position", [=](M& m) { m.position()[0] = nan; }},
          {"velocity", [=](M& m) { m.velocity()[2] = nan; }},
          {"angular_velocity", [](M& m) { m.angular_velocity()[2] = 1e6f; }},
          {"q", [=](M& m) { m.q()[0] = nan; }},
          {"q", [](M& m) { m.q() = {}; }},
      },
      [](const M& m) { return from_idl(m); });
}

TEST(VehicleStatus, RoundTripsAndKnowsOffboardFromOtherModes) {
  AutopilotStatus in{.stamp_s = 4.0,
                     .armed = true,
                     .offboard = true,
                     .mode = FlightMode::kOffboard,
                     .system_id = 7};
  auto out = from_idl(message<msg::VehicleStatus>(in));
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->stamp_s, 4.0);
  EXPECT_TRUE(out->armed && out->offboard && !out->failsafe && !out->user_took_over);
  EXPECT_EQ(out->system_id, 7);
  in = {.stamp_s = 5.0, .failsafe = true, .mode = FlightMode::kPilot, .user_took_over = true};
  out = from_idl(message<msg::VehicleStatus>(in));
  ASSERT_TRUE(out);
  EXPECT_TRUE(!out->armed && !out->offboard && out->failsafe && out->user_took_over);
  EXPECT_EQ(out->mode, FlightMode::kPilot);
}

TEST(VehicleStatus, KnowsWhoFliesInEveryModeOfPx4) {
  const std::map<int, FlightMode> modes = {
      {0, FlightMode::kPilot},     {1, FlightMode::kPilot},  {2, FlightMode::kPilot},
      {3, FlightMode::kOther},     {4, FlightMode::kHold},   {5, FlightMode::kReturn},
      {6, FlightMode::kPilot},     {10, FlightMode::kPilot}, {12, FlightMode::kLand},
      {14, FlightMode::kOffboard}, {15, FlightMode::kPilot}, {17, FlightMode::kTakeOff},
      {18, FlightMode::kLand},     {19, FlightMode::kOther}, {13, FlightMode::kTermination}};
  for (const auto& [number, mode] : modes) {
    auto m = message<msg::VehicleStatus>(AutopilotStatus{.stamp_s = 1.0});
    m.nav_state(static_cast<std::uint8_t>(number));
    EXPECT_EQ(from_idl(m)->mode, mode) << number;
    EXPECT_EQ(from_idl(m)->offboard, number == 14) << number;
  }
}

TEST(ManualControlSetpoint, CountsOnlyWhereItIsValid) {
  msg::ManualControlSetpoint m;
  m.sticks_moving(true);
  EXPECT_FALSE(sticks_moved(m));
  m.valid(true);
  EXPECT_TRUE(sticks_moved(m));
}

TEST(VehicleStatus, EachModeRoundTrips) {
  for (const auto mode :
       {FlightMode::kOffboard, FlightMode::kPilot, FlightMode::kHold, FlightMode::kTakeOff,
        FlightMode::kReturn, FlightMode::kLand, FlightMode::kTermination, FlightMode::kOther}) {
    const AutopilotStatus in{.stamp_s = 4.0,
                             .offboard = mode == FlightMode::kOffboard,
                             .mode = mode,
                             .user_took_over = mode == FlightMode::kPilot};
    const auto out = from_idl(message<msg::VehicleStatus>(in));
    ASSERT_TRUE(out) << out.fault().text;
    EXPECT_EQ(out->mode, mode);
    EXPECT_EQ(out->offboard, in.offboard);
    EXPECT_EQ(out->user_took_over, in.user_took_over);
  }
}

TEST(VehicleStatus, RefusesAnUnknownArmingState) {
  auto m = message<msg::VehicleStatus>(AutopilotStatus{.stamp_s = 1.0});
  m.arming_state(3);
  EXPECT_FALSE(from_idl(m));
}

TEST(VehicleLocalPosition, IsInNed) {
  const auto m = message<msg::VehicleLocalPosition>(state());
  EXPECT_EQ(m.x(), 2.0f);
  EXPECT_EQ(m.y(), 1.0f);
  EXPECT_EQ(m.z(), -3.0f);
  EXPECT_TRUE(m.xy_valid() && m.z_valid() && m.v_xy_valid() && m.v_z_valid());
}

TEST(OffboardControlMode, ControlsPositionsAlone) {
  msg::OffboardControlMode m;
  m.attitude(true);
  to_heartbeat(1.5, m);
  EXPECT_EQ(m.timestamp(), 1'500'000u);
  EXPECT_TRUE(m.position());
  EXPECT_FALSE(m.velocity() || m.attitude() || m.body_rate() || m.direct_actuator());
}

}  // namespace
}  // namespace foretrack
