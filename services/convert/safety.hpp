// SPDX-License-Identifier: Apache-2.0
// The operator's orders and what the safety gate says of itself.
#pragma once

#include "core/safety/gate.hpp"
#include "foretrack_msgs/msg/MissionCommand.h"
#include "foretrack_msgs/msg/SafetyState.h"
#include "services/convert/checks.hpp"

namespace foretrack {

void to_idl(const MissionCommand& command, foretrack_msgs::msg::MissionCommand& out);
/// Ids start at 1: 0 is what an unset message holds. The lease's proof is not judged here: see
/// order_proof.hpp.
Converted<MissionCommand> from_idl(const foretrack_msgs::msg::MissionCommand& in);

/// One tick of the gate, as the world may know it.
struct GateReport {
  double stamp_s = 0.0;
  double caused_by_s = 0.0;  // stamp of the sensor data behind the flown trajectory; 0: none
  GateResult result;
  AutopilotStatus autopilot;
  double odometry_age_s = -1.0;
  MissionOrder order = MissionOrder::kStart;  // the last one, and who gave it
  std::string operator_name = {};
  std::string lease_operator = {};  // empty: nobody holds the lease
  double lease_remaining_s = 0.0;
  std::string hindrance = {};  // why the autopilot would refuse offboard mode; part of the text
  std::string alarm = {};      // a second writer of an input; empty: none
  bool dry_run = false;        // nothing is sent to the autopilot
  std::optional<Vec3> home_enu_m = {};  // where the flight controller would return to
};
void to_idl(const GateReport& report, foretrack_msgs::msg::SafetyState& out);
Converted<GateReport> from_idl(const foretrack_msgs::msg::SafetyState& in);

}  // namespace foretrack
