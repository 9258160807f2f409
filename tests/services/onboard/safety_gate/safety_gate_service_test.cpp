// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/safety_gate/safety_gate_service.hpp"

#include "services/convert/px4.hpp"
#include "services/convert/px4_command.hpp"
#include "services/convert/px4_health.hpp"
#include "services/convert/safety.hpp"
#include "services/convert/trajectory.hpp"
#include "tests/services/onboard/neighbours.hpp"

namespace foretrack::testing {
namespace {

class SafetyGateOnDds : public ::testing::Test {
 protected:
  SafetyGateOnDds() { neighbours_.vehicle.position_enu_m = {0.0, 0.0, 1.5}; }

  void send_autopilot() {
    autopilot_.stamp_s = neighbours_.now_s();
    to_idl(autopilot_, status_.sample());
    status_.write();
  }
  // Hovers where the vehicle is, so that nothing deviates.
  PlannedTrajectory hover_plan() {
    PlannedTrajectory plan;
    plan.id = ++plan_id_;
    plan.stamp_s = neighbours_.now_s() - 0.1;
    plan.start_s = neighbours_.now_s();
    plan.status = PlanStatus::kFresh;
    QuinticPiece piece;
    piece.duration_s = 3.0;
    piece.coefficients.row(0) = neighbours_.vehicle.position_enu_m.transpose();
    plan.pieces = {piece};
    plan.tail_start_s = 2.0;
    plan.yaw = {0.1, {{0.5, 0.0}}};
    return plan;
  }
  void send_plan() {
    to_idl(hover_plan(), plan_.sample());
    plan_.write();
  }
  void send_order(MissionOrder order, std::uint64_t id, const std::string& name = "ada") {
    to_idl(MissionCommand{.id = id,
                          .stamp_s = neighbours_.now_s(),
                          .order = order,
                          .operator_name = name,
                          .lease_id = name + "'s"},
           order_.sample());
    order_.write();
  }
  void feed() {
    neighbours_.send_odometry();
    send_autopilot();
    send_plan();
  }
  void listen() {
    report_reader_.take_each([this](const auto& message) {
      const auto report = from_idl(message);
      ASSERT_TRUE(report) << report.fault().text;
      report_ = *report;
      heard_ = true;
    });
    setpoint_reader_.take_each([this](const auto& message) {
      const auto setpoint = from_idl(message);
      ASSERT_TRUE(setpoint) << setpoint.fault().text;
      setpoint_ = *setpoint;
      ++setpoints_;
    });
    heartbeat_reader_.take_each([this](const auto&) { ++heartbeats_; });
    request_reader_.take_each([this](const auto& message) {
      const auto request = from_idl(message);
      ASSERT_TRUE(request) << request.fault().text;
      request_ = *request;
    });
  }
  bool says(SafetyMode mode) {
    listen();
    return heard_ && report_.result.mode == mode;
  }
  bool says(SafetyMode mode, SafetyReason reason) {
    return says(mode) && report_.result.reason == reason;
  }

  Neighbours neighbours_;
  Writer<topics::Px4VehicleStatus> status_{neighbours_.node()};
  Writer<topics::PlannedTrajectory> plan_{neighbours_.node()};
  Writer<topics::MissionCommand> order_{neighbours_.node()};
  Reader<topics::SafetyState> report_reader_{neighbours_.node()};
  Reader<topics::Px4TrajectorySetpoint> setpoint_reader_{neighbours_.node()};
  Reader<topics::Px4OffboardControlMode> heartbeat_reader_{neighbours_.node()};
  Reader<topics::Px4VehicleCommand> request_reader_{neighbours_.node()};
  Running service_{[](const ServiceOptions& options, Stop& stop) {
    run_safety_gate(options, SafetyParams{}, stop);
  }};
  AutopilotStatus autopilot_{.armed = true, .offboard = true, .mode = FlightMode::kOffboard};
  std::uint64_t plan_id_ = 100;
  GateReport report_;
  Setpoint setpoint_;
  std::optional<AutopilotCommand> request_;
  bool heard_ = false;
  int setpoints_ = 0, heartbeats_ = 0;
};

TEST_F(SafetyGateOnDds, IsSilentWithoutOdometry) {
  ASSERT_TRUE(
      neighbours_.until([&] { return says(SafetyMode::kSilent, SafetyReason::kVehicleStale); },
                        [&] { send_autopilot(), send_plan(); }));
  EXPECT_EQ(setpoints_ + heartbeats_, 0);
}

TEST_F(SafetyGateOnDds, FliesThePlanAndNamesTheDataBehindIt) {
  ASSERT_TRUE(neighbours_.until([&] { return says(SafetyMode::kTrack) && setpoints_ > 5; },
                                [&] { feed(); }));
  EXPECT_LT((setpoint_.position_enu_m - neighbours_.vehicle.position_enu_m).norm(), 1e-3);
  EXPECT_NEAR(setpoint_.yaw_rad, 0.5, 1e-3);
  EXPECT_GT(report_.caused_by_s, neighbours_.now_s() - 5.0);
  EXPECT_GT(heartbeats_, 0);
}

TEST_F(SafetyGateOnDds, SendsNoSetpointBeforeOffboardButAsksForIt) {
  autopilot_.offboard = false;
  autopilot_.mode = FlightMode::kHold;
  ASSERT_TRUE(neighbours_.until(
      [&] {
        listen();
        return heartbeats_ > 0 && request_ && request_->mode == FlightMode::kOffboard;
      },
      [&] { feed(); }));
  EXPECT_EQ(setpoints_, 0);
}

TEST_F(SafetyGateOnDds, SaysWhyTheAutopilotWouldRefuseOffboard) {
  autopilot_.offboard = false;
  autopilot_.mode = FlightMode::kHold;
  Writer<topics::Px4FailsafeFlags> flags(neighbours_.node());
  std::string text;
  ASSERT_TRUE(neighbours_.until(
      [&] {
        report_reader_.take_each([&](const auto& m) { text = m.text().c_str(); });
        return text.find("would refuse: no offboard signal") != std::string::npos;
      },
      [&] {
        feed();
        to_flags(neighbours_.now_s(), false, BatteryWarning::kNone, flags.sample());
        flags.write();
      }))
      << text;
}

TEST_F(SafetyGateOnDds, CoastsAndThenHoversWhenPlansCease) {
  ASSERT_TRUE(neighbours_.until([&] { return says(SafetyMode::kTrack); }, [&] { feed(); }));
  const auto without_plans = [&] { neighbours_.send_odometry(), send_autopilot(); };
  EXPECT_TRUE(neighbours_.until([&] { return says(SafetyMode::kCoast, SafetyReason::kPlanStale); },
                                without_plans));
  EXPECT_TRUE(neighbours_.until([&] { return says(SafetyMode::kHover, SafetyReason::kPlanEnded); },
                                without_plans));
}

TEST_F(SafetyGateOnDds, FallsSilentWhenTheOdometryCeases) {
  ASSERT_TRUE(neighbours_.until([&] { return says(SafetyMode::kTrack); }, [&] { feed(); }));
  ASSERT_TRUE(neighbours_.until([&] { return says(SafetyMode::kSilent); },
                                [&] { send_autopilot(), send_plan(); }));
  EXPECT_FALSE(report_.result.heartbeat);
}

TEST_F(SafetyGateOnDds, ObeysOrdersAndSaysWhoseItWas) {
  ASSERT_TRUE(neighbours_.until([&] { return says(SafetyMode::kTrack); }, [&] { feed(); }));
  std::uint64_t id = 0;
  ASSERT_TRUE(neighbours_.until([&] { return says(SafetyMode::kHover, SafetyReason::kMission); },
                                [&] {
                                  feed();
                                  send_order(MissionOrder::kStop, ++id);
                                }));
  EXPECT_EQ(report_.result.phase, MissionPhase::kStopped);
  EXPECT_EQ(report_.operator_name, "ada");
}

TEST_F(SafetyGateOnDds, TellsWhoHoldsTheLeaseAndRefusesOthers) {
  std::uint64_t id = 0;
  ASSERT_TRUE(neighbours_.until(
      [&] {
        listen();
        return report_.lease_operator == "ada" &&
               report_.result.command_result == MissionResult::kRefusedForeign;
      },
      [&] {
        feed();
        send_order(MissionOrder::kLease, ++id);
        send_order(MissionOrder::kHold, ++id, "bob");
      }));
  EXPECT_EQ(report_.operator_name, "bob");
  EXPECT_EQ(report_.order, MissionOrder::kHold);
  EXPECT_NE(report_.result.phase, MissionPhase::kHolding);
  EXPECT_GT(report_.lease_remaining_s, 0.0);
}

TEST_F(SafetyGateOnDds, RefusesGarbageAndHovers) {
  const auto spoil = [&](auto change) {
    to_idl(hover_plan(), plan_.sample());
    change(plan_.sample());
    plan_.write();
  };
  ASSERT_TRUE(neighbours_.until(
      [&] {
        listen();
        return neighbours_.refused("plan/trajectory") >= 4 &&
               neighbours_.refused("mission/command") >= 1;
      },
      [&] {
        neighbours_.send_odometry();
        send_autopilot();
        spoil([](auto& m) { m.pieces()[0].coefficients()[3][1] = kNaN; });
        spoil([](auto& m) { m.pieces().resize(3000, m.pieces()[0]); });
        spoil([](auto& m) {
          m.pieces().push_back(m.pieces()[0]), m.pieces()[1].coefficients()[0][0] += 5.0;
        });
        spoil([](auto& m) { m.status(99); });
        order_.sample() = {};
        order_.sample().command(250);
        order_.write();
      }));
  EXPECT_TRUE(says(SafetyMode::kHover, SafetyReason::kNoPlanYet));
  EXPECT_TRUE(neighbours_.until([&] { return says(SafetyMode::kTrack); }, [&] { feed(); }));
}

TEST(Px4OdometryOnDds, FliesOnPx4sOwnEstimate) {
  Neighbours neighbours;
  Writer<topics::Px4VehicleOdometry> px4(neighbours.node());
  Reader<topics::Odometry> odometry(neighbours.node());
  Reader<topics::Transforms> transforms(neighbours.node());
  const Running service([](ServiceOptions options, Stop& stop) {
    options.px4_odometry = true;
    run_safety_gate(options, SafetyParams{}, stop);
  });
  VehicleState vehicle;
  vehicle.position_enu_m = {1.0, 2.0, 3.0};
  bool transformed = false;
  std::optional<VehicleState> heard;
  EXPECT_TRUE(neighbours.until(
      [&] {
        const auto state = odometry.take_newest_as(
            [](const nav_msgs::msg::Odometry& message) { return from_idl(message); });
        if (state) heard = state;
        transformed |= transforms.take_newest() != nullptr;
        return heard && transformed;
      },
      [&] {
        vehicle.stamp_s = neighbours.now_s();
        to_idl(vehicle, px4.sample());
        px4.write();
        px4.sample().position()[1] = std::numeric_limits<float>::quiet_NaN();
        px4.write();
      }));
  EXPECT_TRUE(heard && heard->position_enu_m.isApprox(vehicle.position_enu_m, 1e-6));
}

}  // namespace
}  // namespace foretrack::testing
