// SPDX-License-Identifier: Apache-2.0
// A scenario around a vehicle that PX4 flies, in its simulation: people, cameras and the clock by
// us, the vehicle's pose and the time by PX4's odometry, however fast its simulation runs.
#pragma once

#include <optional>

#include "px4_msgs/msg/VehicleOdometry.h"
#include "px4_msgs/msg/VehicleStatus.h"
#include "rosgraph_msgs/msg/Clock.h"
#include "services/simulator/scene_writer.hpp"
#include "services/simulator/simulator_service.hpp"

namespace foretrack {

class AroundPx4 {
 public:
  /// With the first odometry the scenario is placed before the vehicle, and begins; anew when PX4
  /// is restarted. Until the vehicle flies by us, people stand, at most people_wait_s.
  AroundPx4(Service& service, const Scenario& scenario, const SimulatorOptions& options,
            Stop& stop);

 private:
  void hear(const VehicleState& vehicle);
  void begin(const VehicleState& vehicle);
  void step(VehicleState vehicle);
  void tell();

  Stop& stop_;
  Scenario scenario_;
  SimulatorOptions options_;
  std::optional<SimulatorState> state_;  // none: no odometry came yet
  Reader<topics::Px4VehicleOdometry> odometry_;
  Reader<topics::Px4VehicleStatus> status_;
  Writer<topics::Clock> clock_;
  SceneWriter scene_;
  bool flies_ = false;  // by us
  bool people_wait_ = true;
  double begun_s_ = 0.0, people_set_off_s_ = 0.0;  // PX4's time
  long steps_ = 0;
};

/// Until the stop is requested or the scenario is over. Throws as SimulatorService does, and
/// std::invalid_argument for a fleet.
void run_around_px4(const ServiceOptions& options, const Scenario& scenario,
                    const SimulatorOptions& simulator, Stop& stop);

}  // namespace foretrack
