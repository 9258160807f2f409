// SPDX-License-Identifier: Apache-2.0
// The gate's process between fake stages, an operator, and a flight controller that objects as PX4
// does (the simulator's).
#include "services/onboard/safety_gate/safety_gate_service.hpp"

#include <fmt/format.h>

#include <fstream>

#include "core/simulator/autopilot.hpp"
#include "services/convert/bodies.hpp"
#include "services/convert/map.hpp"
#include "services/convert/order_proof.hpp"
#include "services/convert/px4.hpp"
#include "services/convert/px4_command.hpp"
#include "services/convert/px4_health.hpp"
#include "services/convert/px4_home.hpp"
#include "services/convert/safety.hpp"
#include "services/convert/trajectory.hpp"
#include "tests/services/onboard/neighbours.hpp"
#include "tests/support/folder.hpp"

namespace foretrack::testing {
namespace {

constexpr GlobalPlace kOrigin{52.0, 13.0, 30.0};

class SafetyGateOnDds : public ::testing::Test {
 protected:
  SafetyGateOnDds() {
    neighbours_.vehicle.position_enu_m = {0.0, 0.0, 1.5};
    to_idl(free_map(0.0), map_.sample());
    map_.write();
    start_gate();
  }

  void start_gate(bool dry_run = false, const std::string& state = "",
                  const std::string& release = "") {
    gate_.reset();
    report_reader_.take_each([](const auto&) {});  // the last words of the one before
    const std::string folder = state.empty() ? folder_.path.string() : state;
    gate_.emplace([=](ServiceOptions options, Stop& stop) {
      options.state_folder = folder;
      options.dry_run = dry_run;
      options.names.px4_release = release;
      run_safety_gate(options, SafetyParams{}, stop);
    });
    report_ = {};
    reports_ = 0;
  }

  // One step of the flight controller, with what the gate sent since the last one.
  void step_autopilot() {
    AutopilotInput input;
    input.heartbeat = heartbeat_reader_.take_newest() != nullptr;
    heartbeats_ += input.heartbeat;
    setpoint_reader_.take_each_as(
        [](const px4_msgs::msg::TrajectorySetpoint& m) { return from_idl(m); },
        [&](const Setpoint& setpoint) {
          input.setpoint = setpoint_ = setpoint;
          ++setpoints_;
        });
    request_reader_.take_each([this](const auto& m) { waiting_.push_back(m); });
    if (!waiting_.empty()) {
      if (const auto home = home_asked_by(waiting_.front()))
        input.home_enu_m = local_of(kOrigin, *home);
      else
        input.command = *from_idl(waiting_.front());
    }
    VehicleState vehicle = neighbours_.vehicle;
    vehicle.stamp_s = neighbours_.now_s();
    update_autopilot(autopilot_, input, vehicle, 0.02);
    if (autopilot_.answer) {
      to_ack(waiting_.front(), *autopilot_.answer, vehicle.stamp_s, ack_.sample());
      ack_.write();
    }
    if (input.command) asked_.push_back(*input.command);
    if (!waiting_.empty()) waiting_.pop_front();
    to_idl(autopilot_.status, status_.sample());
    status_.write();
  }
  void suffer(IncidentKind kind, FlightMode mode = FlightMode::kPilot) {
    autopilot_.params.incidents.push_back({neighbours_.now_s(), kind, mode});
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
  // Signed, if there is a key. The id is above all before it, unless one is given.
  void send_order(MissionOrder order, const LeaseKey* key = nullptr,
                  const std::string& name = "ada", std::uint64_t id = 0) {
    order_id_ = std::max(order_id_ + 1, id);
    to_idl(MissionCommand{.id = id > 0 ? id : order_id_,
                          .stamp_s = neighbours_.now_s(),
                          .order = order,
                          .operator_name = name,
                          .bounds = bounds_,
                          .person_id = person_id_,
                          .framing = framing_,
                          .return_place_enu_m = return_place_},
           order_.sample());
    if (key) key->sign("uav1", order_.sample());
    order_.write();
  }
  void feed() {
    neighbours_.send_odometry();
    step_autopilot();
    send_plan();
    if (besides_) besides_();
  }
  bool until(const std::function<bool()>& condition) {
    return neighbours_.until(
        [&] {
          listen();
          return condition();
        },
        [&] { feed(); });
  }
  void listen() {
    report_reader_.take_each([this](const auto& message) {
      const auto report = from_idl(message);
      ASSERT_TRUE(report) << report.fault().text;
      report_ = *report;
      text_ = message.text().c_str();
      ++reports_;
    });
  }
  bool says(SafetyMode mode) { return reports_ > 0 && report_.result.mode == mode; }
  bool says(SafetyMode mode, SafetyReason reason) {
    return says(mode) && report_.result.reason == reason;
  }
  bool alarms(const std::string& topic) { return report_.alarm.find(topic) != std::string::npos; }
  bool says(MissionPhase phase) { return reports_ > 0 && report_.result.phase == phase; }
  bool ended(MissionEnd why) { return says(MissionPhase::kIdle) && report_.result.end == why; }
  // Sends the order, once the gate hears, until it has answered.
  bool ordered(MissionOrder order, MissionResult result = MissionResult::kAccepted,
               const LeaseKey* key = nullptr) {
    std::uint64_t sent = 0;
    double again_s = 0.0;
    return until([&] {
      const bool answered = sent > 0 && report_.result.command_id == sent;
      const bool waits = answered && report_.result.command_result == MissionResult::kPending;
      if (answered && report_.result.command_result == result) return true;
      if (reports_ == 0 || order_.readers() == 0 || waits || neighbours_.now_s() < again_s)
        return false;
      send_order(order, key);
      sent = order_id_;
      again_s = neighbours_.now_s() + 1.0;
      return false;
    });
  }
  bool tracks() {
    if (!ordered(MissionOrder::kStart)) return false;
    const auto flies = [&] { return says(SafetyMode::kTrack) && says(MissionPhase::kTracking); };
    if (!until(flies)) return false;
    const int before = setpoints_;
    return until([&] { return setpoints_ > before + 5; });
  }
  // Two seconds of reports in which nothing is asked of the flight controller and nothing is flown.
  bool stays_silent() {
    const std::size_t asked = asked_.size();
    const int heard = reports_;
    if (!until([&] { return reports_ > heard + 5; })) return false;  // what was under way is there
    const int setpoints = setpoints_, heartbeats = heartbeats_;
    return until([&] { return reports_ > heard + 45; }) && asked_.size() == asked &&
           setpoints_ == setpoints && heartbeats_ == heartbeats;
  }

  Folder folder_;
  Neighbours neighbours_;
  Writer<topics::Px4VehicleStatus> status_{neighbours_.node()};
  Writer<topics::Px4VehicleCommandAck> ack_{neighbours_.node()};
  Writer<topics::PlannedTrajectory> plan_{neighbours_.node()};
  Writer<topics::LocalMap> map_{neighbours_.node()};
  Writer<topics::MissionCommand> order_{neighbours_.node()};
  Reader<topics::SafetyState> report_reader_{neighbours_.node()};
  Reader<topics::Px4TrajectorySetpoint> setpoint_reader_{neighbours_.node()};
  Reader<topics::Px4OffboardControlMode> heartbeat_reader_{neighbours_.node()};
  Reader<topics::Px4VehicleCommand> request_reader_{neighbours_.node()};
  Autopilot autopilot_ = make_autopilot({}, VehicleState{.position_enu_m = {0.0, 0.0, 1.5}});
  std::optional<Running> gate_;
  std::deque<px4_msgs::msg::VehicleCommand> waiting_;
  std::vector<AutopilotCommand> asked_;  // of the flight controller, so far
  std::uint64_t plan_id_ = 100, order_id_ = 0;
  FlightBounds bounds_;          // of an order to set them
  std::uint32_t person_id_ = 0;  // of an order to follow
  FlightBounds::Corner return_place_;
  Framing framing_;                // of an order to set it
  std::function<void()> besides_;  // what else comes at 50 Hz
  GateReport report_;
  std::string text_;
  Setpoint setpoint_;
  int reports_ = 0, setpoints_ = 0, heartbeats_ = 0;
};

TEST_F(SafetyGateOnDds, AsksForNothingWithoutAnOrder) {
  ASSERT_TRUE(until([&] { return says(MissionPhase::kIdle); }));
  EXPECT_TRUE(stays_silent());
  EXPECT_TRUE(asked_.empty());
  EXPECT_EQ(setpoints_ + heartbeats_, 0);
}

TEST_F(SafetyGateOnDds, FliesThePlanOnOrderAndNamesTheDataBehindIt) {
  ASSERT_TRUE(tracks());
  EXPECT_LT((setpoint_.position_enu_m - neighbours_.vehicle.position_enu_m).norm(), 1e-3);
  EXPECT_NEAR(setpoint_.yaw_rad, 0.5, 1e-3);
  EXPECT_GT(report_.caused_by_s, neighbours_.now_s() - 5.0);
  ASSERT_EQ(asked_.size(), 1u) << "it was in the air and armed: offboard alone is asked for, once";
  EXPECT_EQ(asked_[0].mode, FlightMode::kOffboard);
}

TEST_F(SafetyGateOnDds, ArmsAParkedVehicleOnOrderAlone) {
  neighbours_.vehicle.position_enu_m.z() = 0.0;
  autopilot_ = make_autopilot({.system_id = 7}, neighbours_.vehicle);
  ASSERT_TRUE(until([&] { return says(MissionPhase::kIdle); }));
  EXPECT_TRUE(ordered(MissionOrder::kStop));
  EXPECT_TRUE(stays_silent());
  EXPECT_FALSE(autopilot_.status.armed) << "STOP armed it";
  EXPECT_TRUE(ordered(MissionOrder::kTakeOff));
  EXPECT_TRUE(until([&] { return autopilot_.status.armed; }));
  EXPECT_TRUE(until([&] { return autopilot_.status.mode == FlightMode::kTakeOff; }));
  for (const auto& command : asked_) EXPECT_EQ(command.target_system, 7);
}

TEST_F(SafetyGateOnDds, LeavesTheVehicleToWhoeverTakesIt) {
  for (const auto& [kind, mode, why] :
       {std::tuple(IncidentKind::kMode, FlightMode::kPilot, MissionEnd::kPilot),
        std::tuple(IncidentKind::kMode, FlightMode::kReturn, MissionEnd::kOtherMode),
        std::tuple(IncidentKind::kBattery, FlightMode::kPilot, MissionEnd::kFailsafe)}) {
    ASSERT_TRUE(tracks());
    suffer(kind, mode);
    EXPECT_TRUE(until([&] { return ended(why); })) << text_;
    EXPECT_TRUE(stays_silent()) << text_;
    EXPECT_FALSE(autopilot_.status.offboard);
    autopilot_ = make_autopilot({}, neighbours_.vehicle);
  }
}

TEST_F(SafetyGateOnDds, GivesUpWithWordsWhatTheFlightControllerDeniesOrDoesNotAnswer) {
  suffer(IncidentKind::kDeny);
  ASSERT_TRUE(ordered(MissionOrder::kStart));
  EXPECT_TRUE(until([&] { return ended(MissionEnd::kRefused); })) << text_;
  EXPECT_NE(text_.find("offboard: denied"), std::string::npos) << text_;
  EXPECT_EQ(asked_.size(), 1u);
  suffer(IncidentKind::kIgnore);
  ASSERT_TRUE(ordered(MissionOrder::kStart));
  EXPECT_TRUE(until([&] { return ended(MissionEnd::kNoAnswer); })) << text_;
  EXPECT_EQ(asked_.size(), 2u);
  EXPECT_TRUE(stays_silent());
}

TEST_F(SafetyGateOnDds, SaysWhyTheAutopilotWouldRefuseOffboard) {
  Writer<topics::Px4FailsafeFlags> flags(neighbours_.node());
  ASSERT_TRUE(until([&] {
    to_flags(neighbours_.now_s(), false, BatteryWarning::kNone, false, flags.sample());
    flags.write();
    return text_.find("would refuse: no offboard signal") != std::string::npos;
  })) << text_;
}

TEST_F(SafetyGateOnDds, CoastsAndThenHoversWhenPlansCease) {
  ASSERT_TRUE(tracks());
  const auto hears = [&](SafetyMode mode, SafetyReason reason) {
    return neighbours_.until(
        [&] {
          listen();
          return says(mode, reason);
        },
        [&] { neighbours_.send_odometry(), step_autopilot(); });
  };
  EXPECT_TRUE(hears(SafetyMode::kCoast, SafetyReason::kPlanStale));
  EXPECT_TRUE(hears(SafetyMode::kHover, SafetyReason::kPlanEnded));
}

TEST_F(SafetyGateOnDds, FallsSilentWhenTheOdometryCeases) {
  ASSERT_TRUE(tracks());
  ASSERT_TRUE(neighbours_.until(
      [&] {
        listen();
        return says(SafetyMode::kSilent);
      },
      [&] { step_autopilot(), send_plan(); }));
  EXPECT_FALSE(report_.result.heartbeat);
}

TEST_F(SafetyGateOnDds, StopOutlivesAKillAndNothingIsResumed) {
  ASSERT_TRUE(tracks());
  ASSERT_TRUE(ordered(MissionOrder::kStop));
  start_gate();
  EXPECT_TRUE(until([&] { return says(MissionPhase::kStopped); })) << text_;
  EXPECT_TRUE(ordered(MissionOrder::kResume, MissionResult::kRefusedPhase));
  start_gate(false, folder_.path.string() + "/empty");
  EXPECT_TRUE(until([&] { return says(MissionPhase::kIdle); })) << "without its file";
}

TEST_F(SafetyGateOnDds, AKilledGateThatTrackedHoldsUntilItIsTold) {
  autopilot_.params.heartbeat_timeout_s = 10.0;  // a busy machine starts processes slowly
  ASSERT_TRUE(tracks());
  start_gate();
  EXPECT_TRUE(until([&] { return says(MissionPhase::kHolding); })) << text_;
  const auto asked = asked_.size();
  EXPECT_TRUE(ordered(MissionOrder::kResume));
  EXPECT_TRUE(until([&] { return says(SafetyMode::kTrack); })) << text_;
  EXPECT_LE(asked_.size(), asked + 1);
}

TEST_F(SafetyGateOnDds, RefusesWhatItCannotRememberButNeverStop) {
  start_gate(false, "/dev/full/none");
  EXPECT_TRUE(ordered(MissionOrder::kStart, MissionResult::kRefusedUnwritten));
  EXPECT_TRUE(ordered(MissionOrder::kStop, MissionResult::kAcceptedUnwritten));
  EXPECT_TRUE(until([&] { return says(MissionPhase::kStopped); }));
}

TEST_F(SafetyGateOnDds, ObeysTheLeasesHolderAloneAlthoughAllReadTheTopic) {
  const LeaseKey ada, bob;
  ASSERT_TRUE(ordered(MissionOrder::kLease, MissionResult::kAccepted, &ada));
  EXPECT_EQ(report_.lease_operator, "ada");
  EXPECT_GT(report_.lease_remaining_s, 0.0);
  const auto overheard = order_.sample();  // as an intruder has it, who writes another order
  EXPECT_TRUE(until([&] {
    order_.sample() = overheard;
    order_.sample().header().stamp(neighbours_.node().clock().now());
    order_.sample().id(++order_id_);
    order_.sample().command(static_cast<std::uint8_t>(MissionOrder::kStart));
    order_.write();
    return report_.result.command_result == MissionResult::kRefusedUnproved;
  }));
  EXPECT_TRUE(ordered(MissionOrder::kLease, MissionResult::kAccepted, &ada));
  EXPECT_TRUE(ordered(MissionOrder::kStart, MissionResult::kRefusedForeign, &bob));
  EXPECT_TRUE(ordered(MissionOrder::kLease, MissionResult::kAccepted, &ada));
  EXPECT_TRUE(ordered(MissionOrder::kStart, MissionResult::kRefusedForeign));
  EXPECT_TRUE(ordered(MissionOrder::kLease, MissionResult::kAccepted, &ada));
  EXPECT_TRUE(ordered(MissionOrder::kStart, MissionResult::kAccepted, &ada));
}

TEST_F(SafetyGateOnDds, AnswersOrdersOfTheFutureAndObeysStopWheneverItWasGiven) {
  ASSERT_TRUE(tracks());
  const auto answers = [&](MissionOrder order, double ahead_s, MissionResult result) {
    return until([&] {
      to_idl(
          MissionCommand{
              .id = ++order_id_, .stamp_s = neighbours_.now_s() + ahead_s, .order = order},
          order_.sample());
      order_.write();
      return report_.order == order && report_.result.command_result == result;
    });
  };
  EXPECT_TRUE(answers(MissionOrder::kHold, 5.0, MissionResult::kRefusedFuture));
  EXPECT_TRUE(answers(MissionOrder::kHold, -5.0, MissionResult::kRefusedLate));
  EXPECT_TRUE(answers(MissionOrder::kStop, 3600.0, MissionResult::kAccepted));
  EXPECT_TRUE(ordered(MissionOrder::kStart)) << "the stamp of that STOP locks nobody out";
}

TEST_F(SafetyGateOnDds, NoIdLocksLaterOrdersOut) {
  ASSERT_TRUE(tracks());
  send_order(MissionOrder::kHold, nullptr, "ada", ~std::uint64_t{0});
  EXPECT_TRUE(until([&] { return says(MissionPhase::kHolding); }));
  order_id_ = 0;
  EXPECT_TRUE(ordered(MissionOrder::kResume));
  EXPECT_TRUE(ordered(MissionOrder::kLand));
}

TEST_F(SafetyGateOnDds, HearsOneWriterOfPlansAndRaisesAnAlarmForASecond) {
  ASSERT_TRUE(tracks());
  Node intruder(node_options("intruder"));
  Writer<topics::PlannedTrajectory> second(intruder);
  besides_ = [&] {
    PlannedTrajectory plan = hover_plan();
    plan.pieces[0].coefficients.row(0) = Vec3(0.0, 0.3, 1.5).transpose();
    to_idl(plan, second.sample());
    second.write();
  };
  EXPECT_TRUE(until([&] { return alarms("plan/trajectory"); })) << text_;
  besides_ = {};
  EXPECT_LT((setpoint_.position_enu_m - neighbours_.vehicle.position_enu_m).norm(), 1e-3);
  EXPECT_TRUE(until([&] { return says(SafetyMode::kTrack); })) << text_;
  EXPECT_LT((setpoint_.position_enu_m - neighbours_.vehicle.position_enu_m).norm(), 1e-3);
}

// ── whose orders they are ──

TEST_F(SafetyGateOnDds, AStrangersOrdersAreAnAlarmAndTheirStopActsAllTheSame) {
  ASSERT_TRUE(tracks());
  const LeaseKey ada;
  ASSERT_TRUE(ordered(MissionOrder::kLease, MissionResult::kAccepted, &ada));
  Node stranger(node_options("stranger"));
  Writer<topics::MissionCommand> second(stranger);
  auto strange = MissionOrder::kHold;
  const auto write_strange = [&] {
    to_idl(MissionCommand{.id = ++order_id_, .stamp_s = neighbours_.now_s(), .order = strange},
           second.sample());
    second.write();
  };
  besides_ = [&] {
    send_order(MissionOrder::kLease, &ada);
    write_strange();
  };
  EXPECT_TRUE(until([&] { return alarms("mission/command"); })) << text_;
  EXPECT_TRUE(says(MissionPhase::kTracking)) << text_;
  strange = MissionOrder::kStop;
  EXPECT_TRUE(until([&] { return says(MissionPhase::kStopped); })) << text_;
}

TEST_F(SafetyGateOnDds, WithoutALeaseASecondSourceIsAnAlarmAndItsLandingActs) {
  ASSERT_TRUE(tracks());
  Node stranger(node_options("stranger"));
  Writer<topics::MissionCommand> second(stranger);
  besides_ = [&] {
    send_order(MissionOrder::kRelease);  // says nothing new
    to_idl(
        MissionCommand{
            .id = ++order_id_, .stamp_s = neighbours_.now_s(), .order = MissionOrder::kLand},
        second.sample());
    second.write();
  };
  EXPECT_TRUE(until([&] { return says(MissionPhase::kLanding); })) << text_;
  EXPECT_TRUE(until([&] { return alarms("mission/command"); })) << text_;
}

TEST_F(SafetyGateOnDds, TheLeasesHolderMayJoinTheBusAnewWithoutAnAlarm) {
  const LeaseKey ada;
  ASSERT_TRUE(ordered(MissionOrder::kLease, MissionResult::kAccepted, &ada));
  Node again(node_options("station"));
  Writer<topics::MissionCommand> second(again);
  std::uint64_t heard = 0;
  besides_ = [&] {
    send_order(MissionOrder::kLease, &ada);
    to_idl(MissionCommand{.id = ++order_id_,
                          .stamp_s = neighbours_.now_s(),
                          .order = MissionOrder::kLease,
                          .operator_name = "ada again"},
           second.sample());
    ada.sign("uav1", second.sample());
    second.write();
  };
  EXPECT_TRUE(until([&] {
    EXPECT_EQ(report_.alarm, "");
    heard += report_.operator_name == "ada again";
    return heard >= 20;
  })) << text_;
}

TEST_F(SafetyGateOnDds, BoundsAreSetUnderTheLeaseAloneAndOutliveAKill) {
  autopilot_.params.heartbeat_timeout_s = 10.0;  // a busy machine starts processes slowly
  const LeaseKey ada;
  const auto under_lease = [&](MissionOrder order, MissionResult result) {
    return ordered(MissionOrder::kLease, MissionResult::kAccepted, &ada) &&
           ordered(order, result, &ada);
  };
  const auto is_outside = [&] { return says(SafetyMode::kHover, SafetyReason::kAltitude); };
  ASSERT_TRUE(tracks());
  bounds_.altitude_max_m = 1.2;  // the vehicle is above
  EXPECT_TRUE(ordered(MissionOrder::kSetBounds, MissionResult::kRefusedUnproved));
  EXPECT_TRUE(ordered(MissionOrder::kSetBounds, MissionResult::kRefusedUnproved, &ada));
  EXPECT_TRUE(under_lease(MissionOrder::kSetBounds, MissionResult::kAccepted)) << text_;
  EXPECT_TRUE(until(is_outside)) << text_;
  start_gate();
  EXPECT_TRUE(under_lease(MissionOrder::kResume, MissionResult::kAccepted)) << text_;
  EXPECT_TRUE(until(is_outside)) << text_;
  bounds_.corner_count = 2;
  EXPECT_TRUE(under_lease(MissionOrder::kSetBounds, MissionResult::kRefusedBounds)) << text_;
  bounds_ = {};
  EXPECT_TRUE(under_lease(MissionOrder::kSetBounds, MissionResult::kAccepted)) << text_;
  EXPECT_TRUE(until([&] { return says(SafetyMode::kTrack); })) << text_;
}

TEST_F(SafetyGateOnDds, WhomToFollowAndFramingAreToldAndOutliveAKill) {
  const LeaseKey ada;
  const auto under_lease = [&](MissionOrder order, MissionResult result) {
    return ordered(MissionOrder::kLease, MissionResult::kAccepted, &ada) &&
           ordered(order, result, &ada);
  };
  Writer<topics::MovingBodies> bodies(neighbours_.node());
  besides_ = [&] {
    MovingBodies people;
    people.stamp_s = neighbours_.now_s();
    people.add({.id = 7, .kind = BodyKind::kPerson, .stamp_s = people.stamp_s});
    to_idl(people, {}, bodies.sample());
    bodies.write();
  };
  ASSERT_TRUE(until([&] { return says(MissionPhase::kIdle); }));
  person_id_ = 7;
  EXPECT_TRUE(ordered(MissionOrder::kFollow, MissionResult::kRefusedUnproved));
  EXPECT_TRUE(under_lease(MissionOrder::kFollow, MissionResult::kAccepted)) << text_;
  EXPECT_EQ(report_.result.person, (PersonChoice{true, 7}));
  person_id_ = 8;
  EXPECT_TRUE(under_lease(MissionOrder::kFollow, MissionResult::kRefusedPerson)) << text_;
  framing_ = {.distance_m = 3.0, .bearing_rad = 1.0};
  EXPECT_TRUE(under_lease(MissionOrder::kSetFraming, MissionResult::kAccepted)) << text_;
  EXPECT_EQ(report_.result.framing, framing_);
  framing_ = {.distance_m = 0.3};
  EXPECT_TRUE(under_lease(MissionOrder::kSetFraming, MissionResult::kRefusedFraming)) << text_;
  start_gate();
  reports_ = 0;
  ASSERT_TRUE(until([&] { return reports_ > 5; }));
  EXPECT_EQ(report_.result.person, (PersonChoice{true, 7}));
  EXPECT_EQ(report_.result.framing, (Framing{.distance_m = 3.0, .bearing_rad = 1.0}));
}

TEST_F(SafetyGateOnDds, AnotherPlaceToReturnToIsTheFlightControllersToKeep) {
  const LeaseKey ada;
  Writer<topics::Px4VehicleLocalPosition> position(neighbours_.node());
  Writer<topics::Px4HomePosition> home(neighbours_.node());
  bool is_global = false;
  besides_ = [&] {
    to_idl(neighbours_.vehicle, position.sample());
    if (is_global) set_origin(kOrigin, position.sample());
    position.write();
    to_idl(kOrigin, autopilot_.home_enu_m, neighbours_.now_s(), home.sample());
    home.write();
  };
  const auto sets_it = [&](const FlightBounds::Corner& place) {
    return_place_ = place;
    return ordered(MissionOrder::kLease, MissionResult::kAccepted, &ada) &&
           ordered(MissionOrder::kSetReturnPlace, MissionResult::kAccepted, &ada);
  };
  const auto is_told = [&](const Vec3& home_enu_m) {
    return report_.home_enu_m && (*report_.home_enu_m - home_enu_m).norm() < 0.01;
  };
  ASSERT_TRUE(until([&] { return is_told(neighbours_.vehicle.position_enu_m); })) << text_;
  return_place_ = {30.0, -40.0};
  EXPECT_TRUE(ordered(MissionOrder::kSetReturnPlace, MissionResult::kRefusedUnproved));
  ASSERT_TRUE(sets_it({30.0, -40.0}));
  EXPECT_TRUE(until([&] {
    return report_.result.asked == AutopilotRequest::kHome &&
           report_.result.answer == CommandResult::kTemporarilyRejected;
  })) << "no place on the Earth is known: "
      << text_;
  is_global = true;
  ASSERT_TRUE(until([&] { return reports_ > 0; }));
  EXPECT_TRUE(sets_it({30.0, -40.0}));
  EXPECT_TRUE(until([&] { return is_told({30.0, -40.0, 1.5}); })) << text_;
  EXPECT_EQ(report_.result.answer, CommandResult::kAccepted) << text_;
}

// ── eyes ──

TEST_F(SafetyGateOnDds, HoversWhileACameraIsBlindAndFliesOnWhenItSees) {
  namespace b = foretrack_msgs::msg::MovingBodies_Constants;
  namespace m = foretrack_msgs::msg::LocalMap_Constants;
  Writer<topics::MovingBodies> bodies(neighbours_.node());
  std::uint8_t color = b::CAMERA_SEES;
  besides_ = [&] {
    MovingBodies nobody;
    nobody.stamp_s = neighbours_.now_s();
    to_idl(nobody, {}, bodies.sample());
    bodies.sample().camera(color);
    bodies.write();
  };
  const auto hovers = [&] { return says(SafetyMode::kHover, SafetyReason::kImages); };
  const auto flies = [&] { return says(SafetyMode::kTrack); };
  ASSERT_TRUE(tracks());
  for (const auto blind : {b::CAMERA_FROZEN, b::CAMERA_DARK, b::CAMERA_COVERED}) {
    color = blind;
    EXPECT_TRUE(until(hovers)) << text_;
    EXPECT_NE(text_.find("images"), std::string::npos) << text_;
    color = b::CAMERA_SEES;
    EXPECT_TRUE(until(flies)) << text_;
  }
  const auto map_says = [&](std::uint8_t depth) {
    to_idl(free_map(0.0), map_.sample());
    map_.sample().camera(depth);
    map_.write();
  };
  EXPECT_TRUE(until([&] {
    map_says(m::CAMERA_COVERED);
    return hovers();
  })) << text_;
  EXPECT_TRUE(until([&] {
    map_says(m::CAMERA_SEES);
    return flies();
  })) << text_;
}

TEST_F(SafetyGateOnDds, ADryRunDecidesAndSendsNothing) {
  start_gate(true);
  ASSERT_TRUE(ordered(MissionOrder::kStart));
  EXPECT_TRUE(until([&] { return says(SafetyMode::kTrack) && report_.result.setpoint; })) << text_;
  EXPECT_TRUE(report_.dry_run);
  EXPECT_TRUE(asked_.empty());
  EXPECT_EQ(setpoints_ + heartbeats_, 0);
}

TEST_F(SafetyGateOnDds, RefusesGarbageAndHolds) {
  ASSERT_TRUE(ordered(MissionOrder::kStart));
  const auto spoil = [&](auto change) {
    to_idl(hover_plan(), plan_.sample());
    change(plan_.sample());
    plan_.write();
  };
  ASSERT_TRUE(until([&] {
    spoil([](auto& m) { m.pieces()[0].coefficients()[3][1] = kNaN; });
    spoil([](auto& m) { m.pieces().resize(3000, m.pieces()[0]); });
    spoil([](auto& m) {
      m.pieces().push_back(m.pieces()[0]), m.pieces()[1].coefficients()[0][0] += 5.0;
    });
    spoil([](auto& m) { m.status(99); });
    order_.sample() = {};
    order_.sample().command(250);
    order_.write();
    return neighbours_.refused("plan/trajectory") >= 4 &&
           neighbours_.refused("mission/command") >= 1;
  }));
  EXPECT_TRUE(until([&] { return says(SafetyMode::kTrack); })) << text_;
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

TEST_F(SafetyGateOnDds, SaysThatTheFlightControllerSpeaksAsAnotherReleaseThanItWasTold) {
  start_gate(false, "", "1.16");
  NodeOptions options = node_options("px4");
  options.names.px4_release = "1.18";
  Node px4(options);
  const Writer<topics::Px4VehicleStatus> status(px4);
  const Writer<topics::Px4BatteryStatus> battery(px4);
  Reader<topics::ServiceHealth> health(neighbours_.node());
  std::string said;
  EXPECT_TRUE(neighbours_.until([&] {
    health.take_each([&](const auto& message) { said = message.last_error().c_str(); });
    return said.find("speaks as PX4 1.18 does, 1.16 is expected") != std::string::npos;
  })) << said;
}

TEST(ReleaseOnDds, AGateThatWasNotToldHearsThatOfTheFlightController) {
  Folder folder;
  Neighbours neighbours;
  NodeOptions options = node_options("px4");
  options.names.px4_release = "1.18";
  Node px4(options);
  Writer<topics::Px4VehicleStatus> status(px4);
  const Writer<topics::Px4BatteryStatus> battery(px4);
  Reader<topics::SafetyState> report(neighbours.node());
  const auto run = [&](ServiceOptions own, Stop& stop) {
    own.state_folder = folder.path.string();
    run_safety_gate(own, SafetyParams{}, stop);
  };
  bool armed = false;
  const auto hears = [&] {
    return neighbours.until(
        [&] {
          report.take_each([&](const auto& state) { armed = state.armed(); });
          return armed;
        },
        [&] {
          to_idl(AutopilotStatus{.stamp_s = neighbours.now_s(), .armed = true}, status.sample());
          status.write();
        });
  };
  std::optional<Running> gate(run);
  ASSERT_TRUE(hears());
  std::string remembered;
  std::ifstream(folder.path / fmt::format("px4-release-{}-uav1", domain_id())) >> remembered;
  EXPECT_EQ(remembered, "1.18") << "which the next one begins with";
  gate.reset();
  gate.emplace(run);
  armed = false;
  EXPECT_TRUE(hears());
}

}  // namespace
}  // namespace foretrack::testing
