// SPDX-License-Identifier: Apache-2.0
#include "services/simulator/simulator_service.hpp"

#include "services/convert/image.hpp"
#include "services/convert/map.hpp"
#include "services/convert/px4.hpp"
#include "services/convert/px4_command.hpp"
#include "services/convert/target.hpp"
#include "tests/services/onboard/neighbours.hpp"
#include "tests/support/mannequin.hpp"

namespace foretrack::testing {
namespace {

Scenario scenario() {
  Scenario s;
  s.world.min_m = {-10, -10, 0};
  s.world.max_m = {10, 10, 4};
  s.world.boxes = {{{3, 3, 0}, {4, 4, 3}}};
  s.target.route_m = {{0, 0}, {8, 0}};
  s.vehicle_enu_m = Vec3(-2.0, 0.0, 1.5);
  s.depth_images = true;
  s.map_resolution_m = 0.25;
  return s;
}

class SimulatorOnDds : public ::testing::Test {
 protected:
  template <class Topic>
  bool hears(Reader<Topic>& reader) {
    return neighbours_.until([&] { return reader.take_newest() != nullptr; });
  }

  Neighbours neighbours_;
  Running service_{[](const ServiceOptions& options, Stop& stop) {
    run_simulator(options, scenario(), {.speed = 2.0, .endless = true}, stop);
  }};
};

TEST_F(SimulatorOnDds, PublishesAVehicleACameraAndAClock) {
  Node& node = neighbours_.node();
  Reader<topics::Clock> clock(node);
  Reader<topics::Odometry> odometry(node);
  Reader<topics::Px4VehicleOdometry> px4_odometry(node);
  Reader<topics::Px4VehicleLocalPosition> position(node);
  Reader<topics::Px4VehicleStatus> status(node);
  Reader<topics::Px4BatteryStatus> battery(node);
  Reader<topics::Px4FailsafeFlags> flags(node);
  Reader<topics::TargetObservation> observation(node);
  Reader<topics::DepthImage> depth(node);
  Reader<topics::DepthCameraInfo> info(node);
  Reader<topics::TargetTruth> target(node);
  Reader<topics::Transforms> transforms(node);
  EXPECT_TRUE(hears(clock));
  EXPECT_TRUE(hears(odometry));
  EXPECT_TRUE(hears(px4_odometry));
  EXPECT_TRUE(hears(position));
  EXPECT_TRUE(hears(status));
  EXPECT_TRUE(hears(battery));
  EXPECT_TRUE(hears(flags));
  EXPECT_TRUE(hears(observation));
  EXPECT_TRUE(hears(depth));
  EXPECT_TRUE(hears(info));
  EXPECT_TRUE(hears(target));
  EXPECT_TRUE(hears(transforms));
}

TEST_F(SimulatorOnDds, GivesLateJoinersTheKnownMapAndTheCamerasMount) {
  Reader<topics::Clock> clock(neighbours_.node());
  ASSERT_TRUE(hears(clock));  // it has been running
  Reader<topics::LocalMap> map(neighbours_.node());
  Reader<topics::StaticTransforms> mount(neighbours_.node());
  std::optional<GridMap> known;
  ASSERT_TRUE(neighbours_.until([&] {
    known = map.take_newest_as(
        [](foretrack_msgs::msg::LocalMap&& m) { return from_idl(std::move(m)); });
    return known.has_value();
  }));
  EXPECT_TRUE(known->is_occupied({3.5, 3.5, 1.0}));
  EXPECT_EQ(known->stamp_s, 0.0);
  const tf2_msgs::msg::TFMessage* transform = nullptr;
  ASSERT_TRUE(neighbours_.until([&] { return (transform = mount.take_newest()) != nullptr; }));
  EXPECT_EQ(transform->transforms().at(0).header().frame_id(), "uav1/base_link");
  EXPECT_EQ(transform->transforms().at(0).child_frame_id(), "uav1/camera_optical_frame");
}

TEST_F(SimulatorOnDds, IsFlownOverPx4sTopics) {
  Node& node = neighbours_.node();
  Writer<topics::Px4OffboardControlMode> heartbeat(node);
  Writer<topics::Px4TrajectorySetpoint> setpoint(node);
  Writer<topics::Px4VehicleCommand> command(node);
  Reader<topics::Px4VehicleStatus> status(node);
  Reader<topics::VehicleTruth> truth(node);
  VehicleState vehicle;
  bool offboard = false;
  const auto fly = [&] {
    to_heartbeat(neighbours_.now_s(), heartbeat.sample());
    heartbeat.write();
    if (!offboard) {
      to_idl(AutopilotCommand{.mode = FlightMode::kOffboard}, neighbours_.now_s(),
             command.sample());
      command.write();
    }
    Setpoint to;
    to.stamp_s = neighbours_.now_s();
    to.position_enu_m = {-2.0, -1.0, 2.0};
    to_idl(to, setpoint.sample());
    setpoint.write();
    // Rubbish beside it must not matter.
    setpoint.sample().position()[0] = std::numeric_limits<float>::infinity();
    setpoint.write();
    command.sample().command(9999);
    command.write();
  };
  EXPECT_TRUE(neighbours_.until(
      [&] {
        status.take_each_as([](const px4_msgs::msg::VehicleStatus& m) { return from_idl(m); },
                            [&](const AutopilotStatus& s) { offboard = s.offboard; });
        truth.take_each_as([](const nav_msgs::msg::Odometry& m) { return from_idl(m); },
                           [&](const VehicleState& s) { vehicle = s; });
        return offboard && (vehicle.position_enu_m - Vec3(-2.0, -1.0, 2.0)).norm() < 0.2;
      },
      fly));
}

TEST_F(SimulatorOnDds, AnswersCommandsToItsSystemAndNoOthers) {
  Node& node = neighbours_.node();
  Writer<topics::Px4VehicleCommand> command(node);
  Reader<topics::Px4VehicleCommandAck> acks(node);
  px4_msgs::msg::VehicleCommand ours;
  to_idl(AutopilotCommand{.mode = FlightMode::kLand}, neighbours_.now_s(), ours);
  bool answered = false, refused = false;
  EXPECT_TRUE(neighbours_.until(
      [&] {
        acks.take_each([&](const px4_msgs::msg::VehicleCommandAck& ack) {
          EXPECT_NE(ack.target_system(), 2);
          answered |= answers(ack, ours) && result_of(ack) == CommandResult::kAccepted;
          refused |= ack.command() == 9999 && result_of(ack) == CommandResult::kUnsupported;
        });
        return answered && refused;
      },
      [&] {
        command.sample() = ours;
        command.write();
        command.sample().command(9999);
        command.write();
        to_idl(AutopilotCommand{.mode = FlightMode::kHold, .target_system = 2}, neighbours_.now_s(),
               command.sample());
        command.write();
      }));
}

TEST(Simulator, PublishesColourImagesInsteadOfLandmarksWhenAsked) {
  Neighbours neighbours;
  Running service([](const ServiceOptions& options, Stop& stop) {
    Scenario filmed = scenario();
    filmed.color_images = true;
    SimulatorOptions own{.speed = 0.5, .endless = true, .person = make_mannequin()};
    run_simulator(options, filmed, own, stop);
  });
  Reader<topics::ColorImage> color(neighbours.node());
  Reader<topics::ColorCameraInfo> info(neighbours.node());
  Reader<topics::DepthImage> depth(neighbours.node());
  Reader<topics::TargetObservation> observation(neighbours.node());
  const sensor_msgs::msg::Image* image = nullptr;
  ASSERT_TRUE(neighbours.until([&] { return (image = color.take_newest()) != nullptr; }));
  EXPECT_EQ(image->encoding(), "rgb8");
  EXPECT_EQ(image->width(), 640U);
  EXPECT_EQ(image->step(), 3U * 640U);
  EXPECT_EQ(image->data().size(), 3U * 640U * 480U);
  const sensor_msgs::msg::CameraInfo* camera = nullptr;
  ASSERT_TRUE(neighbours.until([&] { return (camera = info.take_newest()) != nullptr; }));
  EXPECT_EQ(camera->width(), 640U);
  EXPECT_TRUE(neighbours.until([&] { return depth.take_newest() != nullptr; }));
  EXPECT_EQ(observation.take_newest(), nullptr);
}

// What is heard of one vehicle of a fleet.
struct FleetNeighbour {
  FleetNeighbour(const char* vehicle, const char* px4)
      : node([&] {
          NodeOptions options = node_options("neighbour");
          options.names.vehicle = vehicle;
          options.names.px4_namespace = px4;
          return options;
        }()),
        status(node),
        truth(node),
        target(node) {}
  Node node;
  Reader<topics::Px4VehicleStatus> status;
  Reader<topics::VehicleTruth> truth;
  Reader<topics::TargetTruth> target;
};

TEST(Simulator, VehiclesOfAFleetShareThePersonAndHaveNamesOfTheirOwn) {
  Scenario fleet = scenario();
  fleet.vehicle_enu_m.reset();
  fleet.vehicles.resize(2);
  fleet.vehicles[0] = {.name = "uav1", .position_enu_m = Vec3(-2.0, 0.0, 1.5)};
  fleet.vehicles[1] = {.name = "uav2", .position_enu_m = Vec3(-2.0, 3.0, 1.5)};
  Running service([&](const ServiceOptions& options, Stop& stop) {
    run_simulator(options, fleet, {.speed = 1.0, .endless = true}, stop);
  });
  FleetNeighbour first("uav1", "px4_1"), second("uav2", "px4_2");
  Neighbours neighbours;
  std::optional<AutopilotStatus> status;
  std::optional<VehicleState> one, two, seen_by_one, seen_by_two;
  const auto odometry = [](const nav_msgs::msg::Odometry& m) { return from_idl(m); };
  ASSERT_TRUE(neighbours.until([&] {
    if (auto s = second.status.take_newest_as(
            [](const px4_msgs::msg::VehicleStatus& m) { return from_idl(m); }))
      status = *s;
    if (auto s = first.truth.take_newest_as(odometry)) one = *s;
    if (auto s = second.truth.take_newest_as(odometry)) two = *s;
    if (auto s = first.target.take_newest_as(odometry)) seen_by_one = *s;
    if (auto s = second.target.take_newest_as(odometry)) seen_by_two = *s;
    return status && one && two && seen_by_one && seen_by_two &&
           seen_by_one->stamp_s == seen_by_two->stamp_s;
  }));
  EXPECT_EQ(status->system_id, 3);
  EXPECT_NEAR((one->position_enu_m - two->position_enu_m).norm(), 3.0, 0.3);
  EXPECT_EQ(seen_by_one->position_enu_m, seen_by_two->position_enu_m);
}

TEST(Simulator, RefusesAnImpossibleSpeed) {
  Stop stop;
  EXPECT_THROW(run_simulator(service_options(), scenario(), {.speed = 0.0}, stop),
               std::invalid_argument);
}

TEST(Simulator, EndsWithItsScenario) {
  Scenario brief = scenario();
  brief.duration_s = 0.2;
  Stop stop;
  run_simulator(service_options(), brief, {.speed = 10.0}, stop);
  EXPECT_TRUE(stop.requested());
}

}  // namespace
}  // namespace foretrack::testing
