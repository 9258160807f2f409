// SPDX-License-Identifier: Apache-2.0
// The gate's mode "Follow" over DDS, with a flight controller that keeps modes as PX4 does.
#include "services/onboard/safety_gate/follow_mode_link.hpp"

#include "services/convert/map.hpp"
#include "services/convert/px4.hpp"
#include "services/convert/safety.hpp"
#include "services/convert/trajectory.hpp"
#include "services/onboard/safety_gate/safety_gate_service.hpp"
#include "tests/services/onboard/neighbours.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/mode_keeper.hpp"

namespace foretrack::testing {
namespace {

class FollowModeOnDds : public ::testing::Test {
 protected:
  FollowModeOnDds() {
    neighbours_.vehicle.position_enu_m = {0.0, 0.0, 1.5};
    to_idl(free_map(0.0), map_.sample());
    map_.write();
    autopilot_.mode = FlightMode::kHold;
    start_gate();
  }
  void start_gate(bool dry_run = false) {
    gate_.reset();
    gate_.emplace([=, this](ServiceOptions options, Stop& stop) {
      options.state_folder = folder_.path.string();
      options.external_mode = true;
      options.dry_run = dry_run;
      run_safety_gate(options, SafetyParams{}, stop);
    });
  }
  // As a pilot does: always while it is disarmed, else only what can run.
  bool select(int number) {
    if (autopilot_.armed && !keeper_.can_run(number)) return false;
    selected_ = flies_ = number;
    return true;
  }
  void leave(FlightMode mode) {
    selected_ = flies_ = -1;
    autopilot_.mode = mode;
  }
  void step_autopilot() {
    registration_reader_.take_each([this](const auto& request) {
      ++registrations_;
      registered_ = keeper_.take(request, autopilot_.armed);
      registered_reply_.sample() = registered_;
      registered_reply_.write();
    });
    unregister_reader_.take_each([this](const auto& message) { keeper_.take(message); });
    check_reader_.take_each([this](const auto& reply) { keeper_.take(reply); });
    completed_reader_.take_each([this](const auto& m) { completed_ = m.result(); });
    setpoint_reader_.take_each([this](const auto&) { ++setpoints_; });
    command_reader_.take_each([this](const auto&) { ++commands_; });
    if (const auto question = keeper_.ask(neighbours_.now_s(), selected_)) {
      question_.sample() = *question;
      question_.write();
    }
    if (autopilot_.armed && flies_ >= 0 && !keeper_.can_run(flies_)) {  // PX4's mode fallback
      flies_ = -1;
      autopilot_.failsafe = true;
      autopilot_.mode = FlightMode::kReturn;
    }
    write_status();
  }
  void write_status() {
    autopilot_.stamp_s = neighbours_.now_s();
    to_idl(autopilot_, status_.sample());
    if (flies_ >= 0) status_.sample().nav_state(static_cast<std::uint8_t>(flies_));
    if (selected_ >= 0)
      status_.sample().nav_state_user_intention(static_cast<std::uint8_t>(selected_));
    status_.sample().can_set_nav_states_mask(keeper_.selectable());
    status_.sample().takeoff_time(has_taken_off_ ? 1 : 0);
    status_.write();
  }
  void send_plan() {
    PlannedTrajectory plan;
    plan.id = ++plan_id_;
    plan.stamp_s = neighbours_.now_s() - 0.1;
    plan.start_s = neighbours_.now_s();
    plan.status = PlanStatus::kFresh;
    QuinticPiece piece{.duration_s = 3.0};
    piece.coefficients.row(0) = neighbours_.vehicle.position_enu_m.transpose();
    plan.pieces = {piece};
    plan.tail_start_s = 2.0;
    plan.yaw = {0.1, {{0.5, 0.0}}};
    to_idl(plan, plan_.sample());
    plan_.write();
  }
  bool until(const std::function<bool()>& condition) {
    return neighbours_.until(
        [&] {
          report_reader_.take_each([this](const auto& message) {
            if (const auto report = from_idl(message)) report_ = *report;
            text_ = message.text().c_str();
          });
          return condition();
        },
        [&] {
          neighbours_.send_odometry();
          step_autopilot();
          if (plans_) send_plan();
        });
  }
  bool offered() { return registered_.success() && keeper_.can_run(registered_.mode_id()); }
  bool is(MissionPhase phase) const { return report_.result.phase == phase; }
  bool order(MissionOrder what) {
    return until([&] { return order_.readers() > 0; }) && (write_order(what), true);
  }
  void write_order(MissionOrder what) {
    to_idl(MissionCommand{.id = ++order_id_,
                          .stamp_s = neighbours_.now_s(),
                          .order = what,
                          .operator_name = "ada"},
           order_.sample());
    order_.write();
  }

  Folder folder_;
  Neighbours neighbours_;
  Writer<topics::Px4VehicleStatus> status_{neighbours_.node()};
  Writer<topics::Px4RegisterReply> registered_reply_{neighbours_.node()};
  Writer<topics::Px4ArmingCheckRequest> question_{neighbours_.node()};
  Writer<topics::PlannedTrajectory> plan_{neighbours_.node()};
  Writer<topics::LocalMap> map_{neighbours_.node()};
  Writer<topics::MissionCommand> order_{neighbours_.node()};
  Reader<topics::SafetyState> report_reader_{neighbours_.node()};
  Reader<topics::Px4RegisterRequest> registration_reader_{neighbours_.node()};
  Reader<topics::Px4Unregister> unregister_reader_{neighbours_.node()};
  Reader<topics::Px4ArmingCheckReply> check_reader_{neighbours_.node()};
  Reader<topics::Px4ModeCompleted> completed_reader_{neighbours_.node()};
  Reader<topics::Px4TrajectorySetpoint> setpoint_reader_{neighbours_.node()};
  Reader<topics::Px4VehicleCommand> command_reader_{neighbours_.node()};
  ModeKeeper keeper_;
  px4_msgs::msg::RegisterExtComponentReply registered_;
  AutopilotStatus autopilot_;
  int selected_ = -1, flies_ = -1;  // registered modes; -1: none
  int registrations_ = 0, setpoints_ = 0, commands_ = 0, completed_ = -1;
  bool plans_ = true, has_taken_off_ = true;
  std::uint64_t plan_id_ = 100, order_id_ = 0;
  GateReport report_;
  std::string text_;
  std::optional<Running> gate_;
};

TEST_F(FollowModeOnDds, APilotSelectsItAndTheGateFliesWithoutAskingForAnything) {
  ASSERT_TRUE(until([&] { return offered(); }));
  EXPECT_EQ(registrations_, 1);
  autopilot_.armed = true;
  ASSERT_TRUE(select(registered_.mode_id()));
  EXPECT_TRUE(until([&] { return is(MissionPhase::kTracking) && setpoints_ > 5; }));
  EXPECT_EQ(commands_, 0);
  leave(FlightMode::kPilot);
  EXPECT_TRUE(until([&] { return report_.result.end == MissionEnd::kPilot; }));
  EXPECT_TRUE(until([&] { return offered(); })) << "and may be selected again";
}

TEST_F(FollowModeOnDds, WithoutPlansOrAfterAStopItCannotBeSelectedAndTheReportSaysWhy) {
  plans_ = false;
  ASSERT_TRUE(until([&] {
    return text_.find("mode Follow cannot be selected: no plan yet") != std::string::npos;
  })) << text_;
  autopilot_.armed = true;
  EXPECT_FALSE(select(registered_.mode_id()));
  plans_ = true;
  ASSERT_TRUE(until([&] { return offered(); }));
  ASSERT_TRUE(order(MissionOrder::kStop));
  EXPECT_TRUE(until([&] { return !offered(); }));
  EXPECT_TRUE(until([&] { return text_.find("stop stands") != std::string::npos; })) << text_;
}

// PX4 arms in a registered mode, and then does not take off by its setpoints.
TEST_F(FollowModeOnDds, OnTheGroundItCanNeitherBeArmedInNorFlown) {
  has_taken_off_ = false;
  ASSERT_TRUE(until([&] {
    return text_.find("mode Follow cannot be selected: take off first") != std::string::npos;
  })) << text_;
  ASSERT_TRUE(select(registered_.mode_id())) << "while it is disarmed every mode is taken";
  const auto since_s = neighbours_.now_s();
  EXPECT_TRUE(until([&] { return neighbours_.now_s() - since_s > 1.0; }));
  EXPECT_FALSE(keeper_.can_run(registered_.mode_id()));
  EXPECT_TRUE(is(MissionPhase::kIdle));
  has_taken_off_ = true;
  EXPECT_TRUE(until([&] { return offered(); }));
}

TEST_F(FollowModeOnDds, AFlightControllerThatWasRestartedIsAskedAnew) {
  ASSERT_TRUE(until([&] { return offered(); }));
  keeper_.restart();
  EXPECT_TRUE(until([&] { return registrations_ == 2 && offered(); }));
}

TEST_F(FollowModeOnDds, ItIsRegisteredAfterADisarmAndUntilThenOffboardStays) {
  gate_.reset();
  ASSERT_TRUE(until([&] { return keeper_.selectable() == 0; }))
      << "the gate unregisters at its end";
  const int before = registrations_;
  autopilot_.armed = true;
  start_gate();
  EXPECT_TRUE(until([&] {
    return text_.find("mode Follow: not yet registered; offboard mode stays") != std::string::npos;
  })) << text_;
  EXPECT_EQ(registrations_, before);
  autopilot_.armed = false;
  EXPECT_TRUE(until([&] { return registrations_ > before && offered(); }));
}

TEST_F(FollowModeOnDds, WhenThePlannerDiesTheFlightControllerIsToldAndReturnsForGood) {
  ASSERT_TRUE(until([&] { return offered(); }));
  autopilot_.armed = true;
  ASSERT_TRUE(select(registered_.mode_id()));
  ASSERT_TRUE(until([&] { return is(MissionPhase::kTracking); }));
  plans_ = false;
  ASSERT_TRUE(until([&] { return autopilot_.failsafe; }));
  EXPECT_TRUE(until([&] { return completed_ == 100; }));
  plans_ = true;
  ASSERT_TRUE(until([&] { return report_.result.end == MissionEnd::kFailsafe; }));
  EXPECT_TRUE(until([&] { return text_.find("its mission has ended") != std::string::npos; }))
      << text_;
  EXPECT_FALSE(offered());
}

TEST_F(FollowModeOnDds, ADryRunRegistersNothing) {
  ASSERT_TRUE(until([&] { return registrations_ > 0; }));
  start_gate(true);
  const int before = registrations_;
  ASSERT_TRUE(until([&] { return report_.dry_run && report_.result.mode == SafetyMode::kSilent; }));
  const auto since_s = neighbours_.now_s();
  EXPECT_TRUE(until([&] { return neighbours_.now_s() - since_s > 1.0; }));
  EXPECT_EQ(registrations_, before);
}

}  // namespace
}  // namespace foretrack::testing
