// SPDX-License-Identifier: Apache-2.0
#include "core/safety/ladder.hpp"

#include <array>

namespace foretrack {
namespace {

SafetyReason reason_of(OdometryFault fault) {
  if (fault == OdometryFault::kJumps) return SafetyReason::kOdometryJumps;
  return fault == OdometryFault::kFrozen ? SafetyReason::kOdometryFrozen
                                         : SafetyReason::kOdometryDisagrees;
}

SafetyReason reason_of(PlanFault fault) {
  if (fault == PlanFault::kObstacle) return SafetyReason::kPlanBlocked;
  return fault == PlanFault::kBody ? SafetyReason::kBodyNear : SafetyReason::kFence;
}

SafetyReason reason_of(LimitKind kind) {
  constexpr std::array<SafetyReason, kLimitCount> reasons = {
      SafetyReason::kFence, SafetyReason::kAltitude, SafetyReason::kBattery, SafetyReason::kLink};
  return reasons[static_cast<std::size_t>(kind)];
}

bool follows_plans(MissionPhase phase) {
  return phase == MissionPhase::kTracking || phase == MissionPhase::kStarting;
}

Rung plan_rung(const LadderInput& in) {
  if (!in.has_plan) return {SafetyMode::kHover, SafetyReason::kNoPlanYet};
  if (in.off_trajectory) return {SafetyMode::kBrake, SafetyReason::kOffTrajectory};
  if (in.flown != PlanFault::kNone) return {SafetyMode::kBrake, reason_of(in.flown)};
  if (in.limit.reaction != Reaction::kNone) return {SafetyMode::kHover, reason_of(in.limit.kind)};
  if (in.images_blind) return {SafetyMode::kHover, SafetyReason::kImages};
  if (in.plan_ended)
    return {SafetyMode::kHover,
            in.plan_fresh ? SafetyReason::kPlanHolds : SafetyReason::kPlanEnded};
  return in.plan_fresh ? Rung{SafetyMode::kTrack, SafetyReason::kNone}
                       : Rung{SafetyMode::kCoast, SafetyReason::kPlanStale};
}

}  // namespace

Rung choose_rung(const LadderInput& in) {
  if (in.vehicle_lost) return {SafetyMode::kSilent, SafetyReason::kVehicleStale};
  if (in.autopilot_lost) return {SafetyMode::kSilent, SafetyReason::kAutopilotStale};
  const bool follows = follows_plans(in.phase);
  if (!follows && !in.engaged) return {SafetyMode::kSilent, SafetyReason::kMission};
  // A heartbeat with nothing behind it would hide a dead planner for ever.
  if (in.phase == MissionPhase::kTracking && in.planner_lost)
    return {SafetyMode::kSilent, SafetyReason::kPlanStale};
  if (in.vehicle_stale) return {SafetyMode::kBrake, SafetyReason::kVehicleStale};
  if (in.odometry != OdometryFault::kNone) return {SafetyMode::kBrake, reason_of(in.odometry)};
  // Until the flight controller has taken over what it was asked for, the place is held.
  return follows ? plan_rung(in) : Rung{SafetyMode::kHover, SafetyReason::kMission};
}

std::string_view to_string(SafetyMode mode) {
  constexpr std::array<std::string_view, 5> names = {"track", "coast", "hover", "brake", "silent"};
  return names[static_cast<std::size_t>(mode)];
}
std::string_view to_string(SafetyReason reason) {
  constexpr std::array<std::string_view, 20> names = {
      "",
      "no plan yet",
      "no fresh plan",
      "the plan has ended",
      "the planner holds",
      "the vehicle is off its trajectory",
      "no vehicle state",
      "no word from the flight controller",
      "not in offboard mode",
      "an operator's order",
      "the odometry jumps",
      "the odometry is frozen",
      "the odometry disagrees with its own velocity",
      "an obstacle is in the way",
      "somebody is in the way",
      "outside of the fence",
      "outside of the altitudes",
      "the battery is at its reserve",
      "no word from the operator",
      "the images are frozen, dark or covered"};
  return names[static_cast<std::size_t>(reason)];
}

}  // namespace foretrack
