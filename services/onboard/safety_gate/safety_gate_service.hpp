// SPDX-License-Identifier: Apache-2.0
// Plans, orders and the flight controller's state in; setpoints, the heartbeat and requests out.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "core/safety/gate.hpp"
#include "foretrack_msgs/msg/MissionCommand.h"
#include "foretrack_msgs/msg/PlannedTrajectory.h"
#include "foretrack_msgs/msg/SafetyState.h"
#include "px4_msgs/msg/FailsafeFlags.h"
#include "px4_msgs/msg/OffboardControlMode.h"
#include "px4_msgs/msg/TrajectorySetpoint.h"
#include "px4_msgs/msg/VehicleCommand.h"
#include "px4_msgs/msg/VehicleStatus.h"
#include "services/onboard/inputs.hpp"

namespace foretrack {

/// Ticks at 100 Hz. The only writer of what the flight controller obeys. Its state goes out at
/// 20 Hz, and at once when the mode, the flown trajectory or an order's result changes.
class SafetyGateService {
 public:
  SafetyGateService(Service& service, const SafetyParams& params);

 private:
  void tick();
  void start_simulation(double now_s);
  void command_autopilot(const GateResult& result, double now_s);
  void publish(const GateResult& result, double now_s);
  bool is_news(const GateResult& result) const;

  Service& service_;
  SafetyParams params_;
  GateState state_;
  VehicleInput vehicle_;
  Reader<topics::PlannedTrajectory> plan_reader_;
  Reader<topics::Px4VehicleStatus> autopilot_reader_;
  Reader<topics::Px4FailsafeFlags> flags_reader_;
  Reader<topics::MissionCommand> order_reader_;
  Writer<topics::Px4TrajectorySetpoint> setpoint_;
  Writer<topics::Px4OffboardControlMode> heartbeat_;
  Writer<topics::Px4VehicleCommand> request_;
  Writer<topics::SafetyState> report_;
  std::optional<PlannedTrajectory> plan_;  // that the gate has not seen
  AutopilotStatus autopilot_;
  std::string hindrance_;  // why the autopilot would refuse offboard mode
  std::deque<MissionCommand> orders_;
  GateResult last_;
  double reported_s_ = -1e9;
  double ticked_s_ = -1e18;
};

/// Until the stop is requested.
void run_safety_gate(const ServiceOptions& options, const SafetyParams& params, Stop& stop);

}  // namespace foretrack
