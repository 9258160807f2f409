// SPDX-License-Identifier: Apache-2.0
// What a world and its vehicle put on the bus: sensors, autopilot, truth.
#pragma once

#include "core/simulator/simulate.hpp"
#include "nav_msgs/msg/Odometry.h"
#include "px4_msgs/msg/BatteryStatus.h"
#include "px4_msgs/msg/FailsafeFlags.h"
#include "px4_msgs/msg/HomePosition.h"
#include "px4_msgs/msg/ManualControlSetpoint.h"
#include "px4_msgs/msg/VehicleLocalPosition.h"
#include "px4_msgs/msg/VehicleOdometry.h"
#include "px4_msgs/msg/VehicleStatus.h"
#include "services/common/service.hpp"
#include "services/convert/px4_home.hpp"
#include "services/simulator/scene_writer.hpp"
#include "tf2_msgs/msg/TFMessage.h"

namespace foretrack {

/// Where the simulated worlds' origins lie on the Earth.
inline constexpr GlobalPlace kOriginOfWorlds{52.5145, 13.3501, 35.0};

class WorldWriter {
 public:
  /// Publishes what is latched: the camera's mount and, if the scenario's map is known, the map.
  WorldWriter(Node& node, const Scenario& scenario, const World& world);

  /// One step of 10 ms; slow topics are written every so many steps.
  void publish(const SimulatorOutput& out);

 private:
  void publish_vehicle(const SimulatorOutput& out);
  void publish_autopilot(const SimulatorOutput& out);
  bool every(int steps) const { return steps_ % steps == 0; }

  long steps_ = 0;
  AutopilotStatus autopilot_;
  bool offboard_possible_ = false, trouble_ = false;

  SceneWriter scene_;
  Writer<topics::Odometry> odometry_;
  Writer<topics::Px4VehicleOdometry> px4_odometry_;
  Writer<topics::Px4VehicleLocalPosition> px4_position_;
  Writer<topics::Px4VehicleStatus> px4_status_;
  Writer<topics::Px4BatteryStatus> px4_battery_;
  Writer<topics::Px4HomePosition> px4_home_;
  Writer<topics::Px4FailsafeFlags> px4_flags_;
  Writer<topics::Px4ManualControlSetpoint> px4_sticks_;
  Writer<topics::Transforms> transforms_;
};

}  // namespace foretrack
