// SPDX-License-Identifier: Apache-2.0
// The safety gate: the only place from which setpoints leave. It flies checked trajectories and,
// when they cease to come, steps down a ladder: track, coast, hover, brake, silent.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/common/params.hpp"
#include "core/common/trajectory.hpp"
#include "core/common/vehicle.hpp"
#include "core/safety/mission.hpp"

namespace foretrack {

/// The rungs, best first.
enum class SafetyMode : std::uint8_t {
  kTrack,   // a fresh plan is flown
  kCoast,   // plans have ceased: the last one and its stop tail are flown
  kHover,   // the position is held
  kBrake,   // the velocity is taken out, wherever that ends
  kSilent,  // neither setpoints nor heartbeat: the flight controller's own failsafe takes over
};
enum class SafetyReason : std::uint8_t {
  kNone,
  kNoPlanYet,
  kPlanStale,
  kPlanEnded,
  kPlanHolds,       // the planner itself asks to stand still
  kOffTrajectory,   // the vehicle is far from where it was told to be
  kVehicleStale,    // no vehicle state
  kAutopilotStale,  // nothing heard from the flight controller
  kNotOffboard,     // another mode flies the vehicle
  kMission,         // an operator's order
};
std::string_view to_string(SafetyMode mode);
std::string_view to_string(SafetyReason reason);

struct SafetyParams {
  double plan_fresh_s = 0.25;
  double hover_limit_s = 5.0;
  double vehicle_stale_s = 0.3;
  double autopilot_stale_s = 2.0;
  double max_deviation_m = 1.0;
  double brake_done_m_s = 0.2;
  double command_max_age_s = 1.0;
  double lease_s = 5.0;
  double request_period_s = 0.5;
  double response_s = 0.1;
  bool start_on_launch = true;
};
ParamRows rows(SafetyParams& params);

struct GateInput {
  double now_s = 0.0;
  const PlannedTrajectory* plan = nullptr;  // the newest, or null if none came since the last call
  VehicleState vehicle;
  AutopilotStatus autopilot;
  const MissionCommand* command = nullptr;  // null: none came
};

struct GateState {
  PlannedTrajectory flown;  // from start_s on
  PlannedTrajectory next;   // waits for its start_s
  bool has_flown = false;
  bool has_next = false;
  double last_plan_s = -1.0;  // when the last plan came
  double hover_since_s = -1.0;
  double idle_since_s = -1.0;  // since when no plan has come at all
  std::optional<Vec3> hover_enu_m;
  double hover_yaw_rad = 0.0;
  double last_request_s = -1e9;
  Mission mission;
  MissionCommand last_command;
  MissionResult last_result = MissionResult::kNone;
  bool launched = false;
};

struct GateResult {
  SafetyMode mode = SafetyMode::kSilent;
  SafetyReason reason = SafetyReason::kNone;
  std::optional<Setpoint> setpoint;  // none unless the flight controller is in offboard mode
  bool heartbeat = false;            // offboard_control_mode may be published
  AutopilotRequest request = AutopilotRequest::kNone;
  MissionPhase phase = MissionPhase::kIdle;
  MissionResult command_result = MissionResult::kNone;
  std::uint64_t command_id = 0;  // of the last command; 0: none yet
  double plan_age_s = -1.0;      // < 0: no plan yet
  double deviation_m = 0.0;      // from the flown trajectory
  std::uint64_t plan_id = 0;     // that is flown
};

/// One tick (100 Hz). Precondition: now_s does not fall. Cost: a few microseconds, a copy of a plan
/// when one comes.
GateResult gate(GateState& state, const GateInput& input, const SafetyParams& params);

}  // namespace foretrack
