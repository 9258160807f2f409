// SPDX-License-Identifier: Apache-2.0
// The part of a flight controller that decides who flies, by the rules of PX4 1.16: its failsafes
// and its pilot come before offboard.
#pragma once

#include <optional>
#include <vector>

#include "core/common/vehicle.hpp"
#include "core/simulator/incident.hpp"

namespace foretrack {

/// Of the simulated flight controller.
struct AutopilotParams {
  double heartbeat_timeout_s = 1.0;  // longer without a heartbeat: failsafe (COM_OF_LOSS_T)
  double heartbeat_needed_s = 1.0;   // of unbroken heartbeat before offboard is granted
  double land_speed_m_s = 0.7;
  double return_speed_m_s = 2.0;
  double takeoff_height_m = 2.0;  // above home
  double takeoff_speed_m_s = 1.0;
  double unflown_s = 10.0;  // armed on the ground for so long: disarmed
  int system_id = 1;
  std::vector<Incident> incidents = {};  // by time
};

/// What reaches the autopilot in one step.
struct AutopilotInput {
  bool heartbeat = false;  // OffboardControlMode
  std::optional<Setpoint> setpoint = {};
  std::optional<AutopilotCommand> command = {};
  std::optional<Vec3> home_enu_m = {};  // a command to return there; its height is ignored
};

/// The simulated flight controller: its parameters and what it remembers.
struct Autopilot {
  enum class Manner : std::uint8_t { kObeys, kDenies, kIgnores };

  AutopilotParams params;
  AutopilotStatus status;
  FlightMode user_mode = FlightMode::kHold;  // flies again when a failsafe is over
  bool trouble = false;                      // what a failsafe was for lasts
  Manner manner = Manner::kObeys;
  std::size_t incidents_passed = 0;
  Vec3 home_enu_m = Vec3::Zero();
  double heartbeat_since_s = 0.0;
  double heartbeat_last_s = -1e9;
  double grounded_since_s = 0.0;        // armed, and not yet off the ground
  Setpoint setpoint;                    // that is flown
  std::optional<CommandResult> answer;  // to this step's command; none: it was for another system
};

/// Holds where the vehicle is, which is home: armed in the air, disarmed on the ground.
Autopilot make_autopilot(const AutopilotParams& params, const VehicleState& vehicle);

/// The heartbeat has been unbroken for long enough.
bool may_fly_offboard(const Autopilot& autopilot, double now_s);

/// Armed, and not terminated.
bool motors_turn(const Autopilot& autopilot);

/// Rules, and the setpoint to fly in the next dt_s. Offboard is granted on request after an
/// unbroken heartbeat; setpoints are ignored outside offboard, and the last one is flown on as long
/// as the heartbeat lasts; a lost heartbeat is a failsafe: hold. Only a new request leads back. A
/// request for a mode during another failsafe counts as a user's takeover and ends it. A disarmed
/// vehicle takes every mode; it stays on the ground.
const Setpoint& update_autopilot(Autopilot& autopilot, const AutopilotInput& input,
                                 const VehicleState& vehicle, double dt_s);

}  // namespace foretrack
