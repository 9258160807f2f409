// SPDX-License-Identifier: Apache-2.0
// The part of a flight controller that decides who flies: PX4's offboard rules.
#pragma once

#include <cstdint>
#include <optional>

#include "core/common/vehicle.hpp"

namespace foretrack {

struct AutopilotParams {
  double heartbeat_timeout_s = 0.5;  // longer without a heartbeat: failsafe (PX4's 2 Hz)
  double heartbeat_needed_s = 1.0;   // of unbroken heartbeat before offboard is granted
  double land_speed_m_s = 0.7;
  double return_speed_m_s = 2.0;
};

enum class AutopilotMode : std::uint8_t {
  kHold,      // brake, then hold the place
  kOffboard,  // fly the setpoints that come
  kReturn,    // straight home at the present height, then land
  kLand       // down, and disarm on the ground
};

/// What reaches the autopilot in one step.
struct AutopilotInput {
  bool heartbeat = false;  // OffboardControlMode
  std::optional<Setpoint> setpoint;
  std::optional<bool> arm;
  std::optional<AutopilotMode> mode;  // requested
};

struct Autopilot {
  AutopilotParams params;
  AutopilotStatus status;
  AutopilotMode mode = AutopilotMode::kHold;
  Vec3 home_enu_m = Vec3::Zero();
  double heartbeat_since_s = 0.0;
  double heartbeat_last_s = -1e9;
  Setpoint setpoint;  // that is flown
};

/// Armed and holding where the vehicle is, which is home.
Autopilot make_autopilot(const AutopilotParams& params, const VehicleState& vehicle);

/// The heartbeat has been unbroken for long enough.
bool may_fly_offboard(const Autopilot& autopilot, double now_s);

/// Rules, and the setpoint to fly in the next dt_s. Offboard is granted on request after an
/// unbroken heartbeat; setpoints are ignored outside offboard, and the last one is flown on as long
/// as the heartbeat lasts; a lost heartbeat is a failsafe: hold. Only a new request leads back.
const Setpoint& update_autopilot(Autopilot& autopilot, const AutopilotInput& input,
                                 const VehicleState& vehicle, double dt_s);

}  // namespace foretrack
