// SPDX-License-Identifier: Apache-2.0
#include "services/convert/safety.hpp"

#include "convert_test_support.hpp"

namespace foretrack {
namespace {

using testing::kInf;
using testing::kNaN;
using CommandMsg = foretrack_msgs::msg::MissionCommand;
using StateMsg = foretrack_msgs::msg::SafetyState;

GateReport report() {
  GateReport r;
  r.stamp_s = 30.0;
  r.caused_by_s = 29.75;
  r.autopilot.armed = true;
  r.autopilot.offboard = true;
  r.odometry_age_s = 0.01;
  r.result.mode = SafetyMode::kCoast;
  r.result.reason = SafetyReason::kPlanStale;
  r.result.phase = MissionPhase::kTracking;
  r.result.request = AutopilotRequest::kOffboard;
  r.result.command_result = MissionResult::kRefusedPhase;
  r.result.command_id = 17;
  r.order = MissionOrder::kLease;
  r.operator_name = "bob";
  r.lease_operator = "ada";
  r.lease_remaining_s = 3.5;
  r.result.heartbeat = true;
  r.result.plan_age_s = 0.3;
  r.result.deviation_m = 0.1;
  r.result.plan_id = 99;
  r.result.person = {true, 7};
  r.result.framing = {.distance_m = 3.0, .bearing_rad = 1.5, .circling_rad_s = -0.2};
  Setpoint s;
  s.position_enu_m = {1, 2, 3};
  s.acceleration_enu_m_s2 = Vec3::Constant(kNaN);
  s.yaw_rad = 0.5;
  r.result.setpoint = s;
  return r;
}

template <class Msg, class Core>
Msg message(const Core& core) {
  Msg msg;
  to_idl(core, msg);
  return msg;
}

TEST(SafetyStateMessage, RoundTripsWithUncontrolledFields) {
  const GateReport in = report();
  const auto out = from_idl(message<StateMsg>(in));
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->stamp_s, in.stamp_s);
  EXPECT_EQ(out->caused_by_s, in.caused_by_s);
  EXPECT_EQ(out->odometry_age_s, in.odometry_age_s);
  EXPECT_TRUE(out->autopilot.armed);
  EXPECT_TRUE(out->autopilot.offboard);
  EXPECT_EQ(out->result.mode, in.result.mode);
  EXPECT_EQ(out->result.reason, in.result.reason);
  EXPECT_EQ(out->result.phase, in.result.phase);
  EXPECT_EQ(out->result.request, in.result.request);
  EXPECT_EQ(out->result.command_result, in.result.command_result);
  EXPECT_EQ(out->result.command_id, in.result.command_id);
  EXPECT_EQ(out->order, MissionOrder::kLease);
  EXPECT_EQ(out->operator_name, "bob");
  EXPECT_EQ(out->lease_operator, "ada");
  EXPECT_EQ(out->lease_remaining_s, 3.5);
  EXPECT_TRUE(out->result.heartbeat);
  EXPECT_EQ(out->result.plan_age_s, in.result.plan_age_s);
  EXPECT_EQ(out->result.deviation_m, in.result.deviation_m);
  EXPECT_EQ(out->result.plan_id, in.result.plan_id);
  EXPECT_EQ(out->result.person, in.result.person);
  EXPECT_EQ(out->result.framing, in.result.framing);
  ASSERT_TRUE(out->result.setpoint);
  EXPECT_EQ(out->result.setpoint->position_enu_m, Vec3(1, 2, 3));
  EXPECT_TRUE(std::isnan(out->result.setpoint->acceleration_enu_m_s2.x()));
  EXPECT_EQ(out->result.setpoint->yaw_rad, 0.5);
}

TEST(SafetyStateMessage, ASilentGateHasNoSetpoint) {
  const auto out = from_idl(message<StateMsg>(GateReport{}));
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_FALSE(out->result.setpoint);
  EXPECT_EQ(out->result.mode, SafetyMode::kSilent);
}

TEST(SafetyStateMessage, RefusesEachBadField) {
  using M = StateMsg;
  testing::expect_each_refused<M>(
      message<M>(report()),
      testing::header_faults<M>() +
          std::vector<testing::PlantedFault<M>>{
              {"caused_by", [](M& m) { m.caused_by().nanosec(2'000'000'000u); }},
              {"mode", [](M& m) { m.mode(5); }},
              {"reason", [](M& m) { m.reason(20); }},
              {"phase", [](M& m) { m.phase(8); }},
              {"request", [](M& m) { m.request(9); }},
              {"command_result", [](M& m) { m.command_result(15); }},
              {"plan_age_s", [](M& m) { m.plan_age_s(kNaN); }},
              {"deviation_m", [](M& m) { m.deviation_m(kInf); }},
              {"odometry_age_s", [](M& m) { m.odometry_age_s(kNaN); }},
              {"position_m", [](M& m) { m.position_m()[0] = kInf; }},
              {"velocity_mps", [](M& m) { m.velocity_mps()[0] = 1e3; }},
              {"yaw_rad", [](M& m) { m.yaw_rad(-kInf); }},
              {"framing.distance_m", [](M& m) { m.framing().distance_m(kInf); }},
              {"framing.circling_radps", [](M& m) { m.framing().circling_radps(kNaN); }},
          },
      [](const M& m) { return from_idl(m); });
}

TEST(MissionCommandMessage, RoundTripsAndKeepsTheLease) {
  const MissionCommand in{.id = 5,
                          .stamp_s = 2.5,
                          .order = MissionOrder::kLand,
                          .operator_name = "ada",
                          .lease_id = "lease"};
  CommandMsg msg;
  to_idl(in, msg);
  const auto out = from_idl(msg);
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->id, in.id);
  EXPECT_EQ(out->stamp_s, in.stamp_s);
  EXPECT_EQ(out->order, in.order);
  EXPECT_EQ(out->operator_name.view(), "ada");
  EXPECT_EQ(out->lease_id.view(), "lease");
}

TEST(MissionCommandMessage, CarriesWhomToFollowAndTheFraming) {
  CommandMsg msg;
  to_idl(MissionCommand{.id = 5, .order = MissionOrder::kFollow, .person_id = 12}, msg);
  auto out = from_idl(msg);
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->person_id, 12u);
  EXPECT_TRUE(out->framing.is_free());
  const Framing framing{.height_m = 1.2, .bearing_rad = -0.5, .circling_rad_s = 0.1};
  to_idl(MissionCommand{.id = 6, .order = MissionOrder::kSetFraming, .framing = framing}, msg);
  out = from_idl(msg);
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->framing, framing);
  EXPECT_EQ(out->person_id, 0u);
}

TEST(MissionCommandMessage, CarriesAPlaceToReturnTo) {
  CommandMsg msg;
  to_idl(
      MissionCommand{
          .id = 5, .order = MissionOrder::kSetReturnPlace, .return_place_enu_m = {3.0, -4.0}},
      msg);
  auto out = from_idl(msg);
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->return_place_enu_m, (FlightBounds::Corner{3.0, -4.0}));
  msg.return_place_m()[1] = kNaN;
  out = from_idl(msg);
  ASSERT_FALSE(out);
  EXPECT_EQ(out.fault().field, "return_place_m");
}

TEST(SafetyStateMessage, TellsTheBoundsAsOrderedAndWhereHomeIs) {
  GateReport report;
  report.result.bounds.corner_count = 3;
  report.result.bounds.corners_enu_m[2] = {5.0, 6.0};
  report.result.bounds.altitude_max_m = 12.0;
  report.home_enu_m = Vec3(1.0, 2.0, 3.0);
  StateMsg msg;
  to_idl(report, msg);
  auto out = from_idl(msg);
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->result.bounds, report.result.bounds);
  EXPECT_EQ(out->home_enu_m, report.home_enu_m);
  msg.fence_m().pop_back();
  EXPECT_EQ(from_idl(msg).fault().field, "fence_m");
  report.home_enu_m.reset();
  to_idl(report, msg);
  out = from_idl(msg);
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_FALSE(out->home_enu_m);
}

TEST(MissionCommandMessage, RefusesAFramingThatIsNone) {
  using M = CommandMsg;
  testing::expect_each_refused<M>(
      message<M>(MissionCommand{.id = 1, .stamp_s = 1.0, .order = MissionOrder::kSetFraming}),
      {
          {"framing.distance_m", [](M& m) { m.framing().distance_m(-kInf); }},
          {"framing.height_m", [](M& m) { m.framing().height_m(kInf); }},
          {"framing.bearing_rad", [](M& m) { m.framing().bearing_rad(1e9); }},
          {"framing.circling_radps", [](M& m) { m.framing().circling_radps(kNaN); }},
      },
      [](const M& m) { return from_idl(m); });
}

TEST(MissionCommandMessage, RefusesEachBadField) {
  using M = CommandMsg;
  testing::expect_each_refused<M>(
      message<M>(MissionCommand{.id = 1, .stamp_s = 1.0, .order = MissionOrder::kStop}),
      {
          {"header.stamp", [](M& m) { m.header().stamp().sec(-1); }},
          {"command", [](M& m) { m.command(13); }},
          {"id", [](M& m) { m.id(0); }},
      },
      [](const M& m) { return from_idl(m); });
}

}  // namespace
}  // namespace foretrack
