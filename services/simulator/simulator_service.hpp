// The simulator on the bus: vehicle, autopilot and cameras out, PX4's inputs in, at a steady pace.
#pragma once

#include <optional>

#include "core/simulator/simulate.hpp"
#include "foretrack_msgs/msg/LocalMap.h"
#include "foretrack_msgs/msg/TargetObservation.h"
#include "nav_msgs/msg/Odometry.h"
#include "px4_msgs/msg/BatteryStatus.h"
#include "px4_msgs/msg/FailsafeFlags.h"
#include "px4_msgs/msg/OffboardControlMode.h"
#include "px4_msgs/msg/TrajectorySetpoint.h"
#include "px4_msgs/msg/VehicleCommand.h"
#include "px4_msgs/msg/VehicleLocalPosition.h"
#include "px4_msgs/msg/VehicleOdometry.h"
#include "px4_msgs/msg/VehicleStatus.h"
#include "rosgraph_msgs/msg/Clock.h"
#include "sensor_msgs/msg/CameraInfo.h"
#include "sensor_msgs/msg/Image.h"
#include "services/common/service.hpp"
#include "tf2_msgs/msg/TFMessage.h"

namespace foretrack {

struct SimulatorOptions {
  double speed = 1.0;    // simulated seconds in a second
  bool endless = false;  // goes on after the scenario's duration
  std::shared_ptr<const PersonModel> person =
      nullptr;  // to be rendered, if the scenario has colour images
};

/// Steps of 10 ms simulated time from 0, each announced on the clock topic after its data. Under
/// load it falls behind rather than leap. A known map is published once, latched, with stamp 0.
class SimulatorService {
 public:
  /// Throws as make_simulator does; std::invalid_argument if the speed is not within 0.01 to 100.
  SimulatorService(Service& service, const Scenario& scenario, const SimulatorOptions& options,
                   Stop& stop);

 private:
  void step();
  AutopilotInput take_input();
  void take_commands(AutopilotInput& input);
  void publish_vehicle(const SimulatorOutput& out);
  void publish_autopilot(const SimulatorOutput& out);
  void publish_cameras(const SimulatorOutput& out);
  void publish_truth(const SimulatorOutput& out);
  void publish_latched();
  bool every(int steps) const { return steps_ % steps == 0; }

  Node& node_;
  Stop& stop_;
  SimulatorOptions options_;
  SimulatorState state_;
  long steps_ = 0;
  AutopilotStatus autopilot_;
  bool offboard_possible_ = false;

  Reader<topics::Px4OffboardControlMode> heartbeat_;
  Reader<topics::Px4TrajectorySetpoint> setpoint_;
  Reader<topics::Px4VehicleCommand> command_;
  Writer<topics::Clock> clock_;
  Writer<topics::Odometry> odometry_;
  Writer<topics::Px4VehicleOdometry> px4_odometry_;
  Writer<topics::Px4VehicleLocalPosition> px4_position_;
  Writer<topics::Px4VehicleStatus> px4_status_;
  Writer<topics::Px4BatteryStatus> px4_battery_;
  Writer<topics::Px4FailsafeFlags> px4_flags_;
  std::optional<Writer<topics::TargetObservation>> observation_;  // not beside images
  Writer<topics::DepthImage> depth_;
  Writer<topics::DepthCameraInfo> camera_info_;
  Writer<topics::ColorImage> color_;
  Writer<topics::ColorCameraInfo> color_info_;
  Writer<topics::TargetTruth> target_truth_;
  Writer<topics::VehicleTruth> vehicle_truth_;
  Writer<topics::Transforms> transforms_;
  Writer<topics::StaticTransforms> mount_;
  Writer<topics::LocalMap> map_;
};

/// Until the stop is requested or the scenario is over.
void run_simulator(const ServiceOptions& options, const Scenario& scenario,
                   const SimulatorOptions& simulator, Stop& stop);

}  // namespace foretrack
