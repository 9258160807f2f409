// SPDX-License-Identifier: Apache-2.0
// The ladder: what is flown at worst, and why. Track, coast, hover, brake, silent.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/safety/mission.hpp"
#include "core/safety/plan_fault.hpp"
#include "core/safety/watch_limits.hpp"
#include "core/safety/watch_odometry.hpp"

namespace foretrack {

/// The rungs, best first.
enum class SafetyMode : std::uint8_t {
  kTrack,   // a fresh plan is flown
  kCoast,   // plans have ceased: the last one and its stop tail are flown
  kHover,   // the position is held
  kBrake,   // the velocity is taken out, wherever that ends
  kSilent,  // neither setpoints nor heartbeat: the flight controller's own failsafe takes over
};
/// Why the gate stands on its rung.
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
  kOdometryJumps,
  kOdometryFrozen,     // it stands still while motion is commanded
  kOdometryDisagrees,  // with its own velocity
  kPlanBlocked,        // what is flown leads into what the map says now
  kBodyNear,           // what is flown leads too near to somebody
  kFence,
  kAltitude,
  kBattery,
  kLink,    // no word from the operator
  kImages,  // frozen, dark or covered
};
/// For logs and displays.
std::string_view to_string(SafetyMode mode);
/// For logs and displays.
std::string_view to_string(SafetyReason reason);

/// A mode and the reason for it.
struct Rung {
  SafetyMode mode = SafetyMode::kSilent;
  SafetyReason reason = SafetyReason::kNone;
};

/// What the watches say. Each has its own hysteresis; the ladder adds none.
struct LadderInput {
  bool autopilot_lost = false;
  bool vehicle_lost = false;   // no state for so long that nothing can be flown
  bool vehicle_stale = false;  // no state for a moment
  OdometryFault odometry = OdometryFault::kNone;
  bool images_blind = false;
  LimitVerdict limit;
  MissionPhase phase = MissionPhase::kIdle;
  bool engaged = false;
  bool planner_lost = false;           // nothing was heard of it for too long
  bool has_plan = false;               // there is one to fly
  bool off_trajectory = false;         // the vehicle is far from it
  PlanFault flown = PlanFault::kNone;  // what it leads into
  bool plan_fresh = false;
  bool plan_ended = false;
};

/// The first that holds, from the worst: what is flown, and why.
Rung choose_rung(const LadderInput& input);

}  // namespace foretrack
