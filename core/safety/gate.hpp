// SPDX-License-Identifier: Apache-2.0
// The safety gate: the only place from which setpoints leave. It flies checked trajectories and,
// when they cease to come, steps down a ladder: track, coast, hover, brake, silent. It never takes
// the vehicle: the flight controller is asked once for an operator's order.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/common/battery_state.hpp"
#include "core/common/grid_map.hpp"
#include "core/common/moving_body.hpp"
#include "core/common/trajectory.hpp"
#include "core/common/vehicle.hpp"
#include "core/safety/follow_mode.hpp"
#include "core/safety/ladder.hpp"
#include "core/safety/safety_params.hpp"
#include "core/safety/take_order.hpp"

namespace foretrack {

/// What has come, and when by the monotonic clock (-1: never). Pointers: null, nothing new came.
/// Stamps are read from a clock that may be set at any time: they are compared with `stamp_now_s`
/// only.
struct GateInput {
  double now_s = 0.0;                       // monotonic
  double stamp_now_s = 0.0;                 // the same moment, as stamps have it
  const PlannedTrajectory* plan = nullptr;  // the newest since the last call
  VehicleState vehicle;
  double vehicle_at_s = -1.0;
  AutopilotStatus autopilot;
  double autopilot_at_s = -1.0;
  const AutopilotAck* ack = nullptr;
  const MissionCommand* command = nullptr;
  const GridMap* map = nullptr;  // the newest there is, new or not
  double map_at_s = -1.0;
  const MovingBodies* bodies = nullptr;  // the newest there are
  double bodies_at_s = -1.0;
  const BatteryState* battery = nullptr;  // the newest there is
  double operator_at_s = -1.0;            // the operator's last heartbeat
  bool images_blind = false;              // a camera or the depth image is frozen, dark or covered
  MemoryWriting writing;
};

/// What the gate remembers from tick to tick.
struct GateState {
  GateState();

  PlannedTrajectory flown;  // start_s is on the monotonic clock, as in next
  PlannedTrajectory next;   // waits for its start_s
  bool has_flown = false;
  bool has_next = false;
  std::uint64_t newest_id = 0;           // of the plans that were taken
  double last_plan_s = -1.0;             // when the last plan came that may be flown
  double last_heard_s = -1.0;            // or any
  double last_fresh_s = -1e9;            // when the last one came that follows a target
  PlanFault refusal = PlanFault::kNone;  // of the last plan
  PlanFaultCounts refused{};
  Latch flown_latch, vehicle_latch, image_latch;
  PlanFault flown_fault = PlanFault::kNone;  // that was seen last
  OdometryWatch odometry;
  LimitWatch limits;
  DeviationBound deviation;  // of the vehicle from what is flown, as measured
  double measured_s = -1.0;  // when the odometry came by which it was measured last
  double ground_m = 0.0;     // below the vehicle, as it was known last
  double ticked_s = -1.0;
  double heartbeat_since_s = 1e18;
  SafetyMode mode = SafetyMode::kSilent;
  bool flies_plans = false;  // the last setpoint was of a plan
  Vec3 commanded_enu_m_s = Vec3::Zero();
  std::optional<Vec3> hover_enu_m;
  double hover_yaw_rad = 0.0;
  Mission mission;
  OrderState order;
  CarryOut carrying;
  HomeAsking home;
  FollowMode follow_mode;
  GateMemory memory;
  double begun_s = -1.0;  // the first tick
};

/// What goes out in one tick, and why.
struct GateResult {
  SafetyMode mode = SafetyMode::kSilent;
  SafetyReason reason = SafetyReason::kNone;
  std::optional<Setpoint> setpoint;  // none unless the flight controller is in offboard mode
  bool heartbeat = false;            // offboard_control_mode may be published
  AutopilotRequest request = AutopilotRequest::kNone;
  MissionPhase phase = MissionPhase::kIdle;
  MissionEnd end = MissionEnd::kNone;                // of the last mission, until the next order
  AutopilotRequest asked = AutopilotRequest::kNone;  // the last request
  CommandResult answer = CommandResult::kAccepted;   // to it
  MissionResult command_result = MissionResult::kNone;
  std::uint64_t command_id = 0;          // of the last command; 0: none yet
  bool memory_changed = false;           // state.memory is to be written
  double plan_age_s = -1.0;              // < 0: no plan yet
  double deviation_m = 0.0;              // from the flown trajectory
  std::uint64_t plan_id = 0;             // that is flown
  PlanFault refusal = PlanFault::kNone;  // of the last plan that came
  LimitVerdict limit;
  PersonChoice person;  // as ordered, as are framing and bounds
  Framing framing;
  FlightBounds bounds;
  FlightBounds::Corner return_place_enu_m;              // of the request for another home
  ModeHindrance mode_hindrance = ModeHindrance::kNone;  // of the mode that a pilot selects
  SafetyReason mode_reason = SafetyReason::kNone;       // why it is not ready
};

/// The setpoint is of a plan: the vehicle is not held, and nobody else flies it.
bool flies_plan(const GateResult& result);

/// One tick (100 Hz). Precondition: now_s does not fall. Allocates nothing, throws nothing. Bounded
/// cost.
GateResult gate(GateState& state, const GateInput& input, const SafetyParams& params);

/// Before the first tick after a restart: what the memory says. Nothing is resumed.
void restore(GateState& state, const GateMemory& memory, double now_s, const SafetyParams& params);

}  // namespace foretrack
