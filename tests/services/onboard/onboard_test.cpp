// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/onboard.hpp"

#include <gmock/gmock.h>

#include "services/convert/safety.hpp"
#include "services/convert/trajectory.hpp"
#include "services/files/config/load_scenario.hpp"
#include "services/onboard/safety_gate/safety_gate_service.hpp"
#include "services/simulator/simulator_service.hpp"
#include "tests/services/onboard/neighbours.hpp"

namespace foretrack::testing {
namespace {

// The whole vehicle against the simulator at its natural pace; what is seen is only what the bus
// says.
class FlightOnDds : public ::testing::Test {
 protected:
  explicit FlightOnDds(const char* scenario = "open_field", MapSource map = MapSource::kKnown) {
    ScenarioOverrides overrides;
    overrides.map = map;
    scenario_ = load_scenario(scenario, overrides);
    simulator_.emplace([this](const ServiceOptions& options, Stop& stop) {
      run_simulator(options, scenario_, {.speed = 1.0, .endless = true}, stop);
    });
    stages_.emplace([map](ServiceOptions options, Stop& stop) {
      options.use_sim_time = true;
      run_stages(options, TrackerParams{}, {.mapping = map == MapSource::kDepth}, stop);
    });
    gate_.emplace([](ServiceOptions options, Stop& stop) {
      options.use_sim_time = true;
      run_safety_gate(options, SafetyParams{}, stop);
    });
  }

  void listen() {
    report_reader_.take_each_as(
        [](const foretrack_msgs::msg::SafetyState& message) { return from_idl(message); },
        [this](const GateReport& report) { report_ = report; });
    target_reader_.take_each_as(
        [](const nav_msgs::msg::Odometry& message) { return from_idl(message); },
        [this](const VehicleState& state) { target_ = state; });
    vehicle_reader_.take_each_as(
        [](const nav_msgs::msg::Odometry& message) { return from_idl(message); },
        [this](const VehicleState& state) { vehicle_ = state; });
  }
  // By the gate's clock, which is simulated.
  void order_start() {
    if (report_.result.phase != MissionPhase::kIdle || report_.stamp_s < next_order_s_) return;
    next_order_s_ = report_.stamp_s + 0.5;
    to_idl(MissionCommand{.id = ++order_id_, .stamp_s = report_.stamp_s}, order_.sample());
    order_.write();
  }
  bool tracks() {
    listen();
    order_start();
    return report_.result.mode == SafetyMode::kTrack && report_.autopilot.offboard;
  }
  double distance_m() const { return distance_xy(target_.position_enu_m, vehicle_.position_enu_m); }

  Scenario scenario_;
  std::optional<Running> simulator_, stages_, gate_;
  Neighbours neighbours_;
  Reader<topics::SafetyState> report_reader_{neighbours_.node()};
  Reader<topics::TargetTruth> target_reader_{neighbours_.node()};
  Reader<topics::VehicleTruth> vehicle_reader_{neighbours_.node()};
  Writer<topics::MissionCommand> order_{neighbours_.node()};
  std::uint64_t order_id_ = 0;
  double next_order_s_ = 0.1;  // once there is a clock
  GateReport report_;
  VehicleState target_, vehicle_;
};

class FlightWithDepth : public FlightOnDds {
 protected:
  FlightWithDepth() : FlightOnDds("open_field", MapSource::kDepth) {}
};

TEST_F(FlightOnDds, FollowsThePersonInAKnownMap) {
  ASSERT_TRUE(neighbours_.until([&] { return tracks(); }));
  const Vec3 start = target_.position_enu_m;
  ASSERT_TRUE(neighbours_.until([&] {
    listen();
    return distance_xy(target_.position_enu_m, start) > 4.0;
  }));
  EXPECT_LT(distance_m(), 4.0);
  EXPECT_GT(distance_m(), 0.8);
}

TEST_F(FlightWithDepth, FollowsThePersonInAMapOfItsOwn) {
  ASSERT_TRUE(neighbours_.until([&] { return tracks(); }));
  const Vec3 start = target_.position_enu_m;
  ASSERT_TRUE(neighbours_.until([&] {
    listen();
    return distance_xy(target_.position_enu_m, start) > 4.0;
  }));
  EXPECT_LT(distance_m(), 4.0);
}

TEST(Onboard, NamesItsServicesInTheOrderOfThePipeline) {
  std::vector<std::string> names;
  for (const auto& service : onboard_services()) names.push_back(service.name);
  EXPECT_THAT(names, ::testing::ElementsAre("perception", "mapping", "prediction", "fleet",
                                            "planning", "safety_gate"));
}

TEST(Onboard, ThrowsWhatAServiceCouldNotStartWith) {
  ServiceOptions options = service_options();
  options.names.vehicle = "Not A Name";
  Stop stop;
  EXPECT_THROW(run_stages(options, TrackerParams{}, {}, stop), std::invalid_argument);
}

}  // namespace
}  // namespace foretrack::testing
