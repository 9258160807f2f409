// The part of a flight controller that decides who flies: PX4's offboard rules.
#pragma once

#include <optional>

#include "core/common/vehicle.hpp"

namespace foretrack {

struct AutopilotParams {
  double heartbeat_timeout_s = 0.5;  // longer without a heartbeat: failsafe (and PX4's 2 Hz)
  double heartbeat_needed_s = 1.0;   // of unbroken heartbeat before offboard is granted
};

/// What reaches the autopilot in one step.
struct AutopilotInput {
  bool heartbeat = false;  // OffboardControlMode
  std::optional<Setpoint> setpoint;
  std::optional<bool> arm;  // request
  bool offboard = false;    // request to switch to offboard
  bool hold = false;        // request to switch to hold
};

struct Autopilot {
  AutopilotParams params;
  AutopilotStatus status;
  double heartbeat_since_s = 0.0;
  double heartbeat_last_s = -1e9;
  Setpoint setpoint;  // that is flown
};

/// Armed and holding where the vehicle is.
Autopilot make_autopilot(const AutopilotParams& params, const VehicleState& vehicle);

/// Rules, and the setpoint to fly now. Offboard is granted on request after an unbroken heartbeat;
/// setpoints are ignored outside offboard, and the last one is flown on as long as the heartbeat
/// lasts; a lost heartbeat is a failsafe: brake, then hold. Needs a new request to return.
const Setpoint& update_autopilot(Autopilot& autopilot, const AutopilotInput& input,
                                 const VehicleState& vehicle);

}  // namespace foretrack
