// SPDX-License-Identifier: Apache-2.0
// The gate against a vehicle that follows its setpoints and a flight controller that objects as a
// real one does.
#pragma once

#include <optional>

#include "core/safety/gate.hpp"

namespace foretrack::testing {

inline constexpr double kTick_s = 0.01;

/// Straight along x at 0.5 m/s for 2 s, then to rest within 1 s.
inline PlannedTrajectory straight_plan(std::uint64_t id, double start_s, double from_x_m = 0.0) {
  PlannedTrajectory plan;
  plan.id = id;
  plan.stamp_s = plan.start_s = start_s;
  plan.status = PlanStatus::kFresh;
  QuinticPiece cruise{.duration_s = 2.0};
  cruise.coefficients.row(0) = Vec3(from_x_m, 0, 1.5);
  cruise.coefficients.row(1) = Vec3(0.5, 0, 0);
  // p = x + (t − t³ + t⁴/2) / 2: v(0) = 0.5, v(1) = 0, a(0) = a(1) = 0.
  QuinticPiece tail{.duration_s = 1.0};
  tail.coefficients.row(0) = Vec3(from_x_m + 1.0, 0, 1.5);
  tail.coefficients.row(1) = Vec3(0.5, 0, 0);
  tail.coefficients.row(3) = Vec3(-0.5, 0, 0);
  tail.coefficients.row(4) = Vec3(0.25, 0, 0);
  plan.pieces = {cruise, tail};
  plan.tail_start_s = 2.0;
  plan.yaw.nodes = {{0.0, 0.0}};
  return plan;
}

/// Stands where it is.
inline PlannedTrajectory still_plan(std::uint64_t id, double start_s, const Vec3& place_enu_m) {
  PlannedTrajectory plan;
  plan.id = id;
  plan.stamp_s = plan.start_s = start_s;
  plan.status = PlanStatus::kFresh;
  plan.pieces = {QuinticPiece{.duration_s = 1.0}};
  plan.pieces[0].coefficients.row(0) = place_enu_m;
  plan.tail_start_s = 0.5;
  plan.yaw.nodes = {{0.0, 0.0}};
  return plan;
}

/// Free as far as it reaches, from the ground, (−10, −10, 0), to (20, 10, 6), and given once and
/// for all.
inline const GridMap& open_map() {
  static const GridMap map = [] {
    GridMap free;
    free.resolution_m = 0.25;
    free.origin_enu_m = Vec3(-10.0, -10.0, 0.0);
    free.size = {120, 80, 24};
    free.cells.assign(free.cell_count(), static_cast<std::uint8_t>(Cell::kFree));
    free.occupied_distance_cm.assign(free.cell_count(), 255);
    free.unfree_distance_cm.assign(free.cell_count(), 255);
    return free;
  }();
  return map;
}

/// Grants what is asked in the next tick, with an answer, unless told otherwise.
struct FakeAutopilot {
  AutopilotStatus status{.stamp_s = 0.0, .armed = true, .mode = FlightMode::kHold};
  std::optional<CommandResult> answer = CommandResult::kAccepted;  // none: it does not answer
  bool deaf = false;                                               // and does not do it either
  std::array<int, 9> asked{};                                      // how often, by request
  std::optional<AutopilotAck> ack;                                 // for the gate's next tick

  void enter(FlightMode mode) {
    status.mode = mode;
    status.offboard = mode == FlightMode::kOffboard;
  }
  void take(AutopilotRequest request) {
    ack.reset();
    if (request == AutopilotRequest::kNone) return;
    ++asked[static_cast<int>(request)];
    if (answer) ack = AutopilotAck{request, *answer};
    if (deaf || (answer && *answer != CommandResult::kAccepted)) return;
    if (request == AutopilotRequest::kHome) return;  // no mode
    constexpr FlightMode modes[] = {
        FlightMode::kUnknown, FlightMode::kUnknown, FlightMode::kOffboard,
        FlightMode::kReturn,  FlightMode::kLand,    FlightMode::kTakeOff,
        FlightMode::kHold,    FlightMode::kUnknown, FlightMode::kPilot};
    if (request == AutopilotRequest::kArm)
      status.armed = true;
    else
      enter(modes[static_cast<int>(request)]);
  }
  int count(AutopilotRequest request) const { return asked[static_cast<int>(request)]; }
  int total() const {
    int sum = 0;
    for (const int n : asked) sum += n;
    return sum;
  }
};

/// Ticks at 100 Hz. The vehicle is where its setpoint was, unless it is displaced.
struct FlightLoop {
  SafetyParams params;
  GateState state;
  FakeAutopilot autopilot;
  GateResult result;
  double now_s = 0.0, clock_offset_s = 0.0;  // stamps are ahead of the monotonic clock by it
  bool vehicle_alive = true, autopilot_alive = true;
  std::optional<Vec3> displaced;
  VehicleState vehicle{.position_enu_m = Vec3(0, 0, 1.5)};
  double vehicle_at_s = -1.0, autopilot_at_s = -1.0;
  std::uint64_t last_order = 0, last_plan = 0;
  GateInput extra;  // map, bodies, battery, …

  FlightLoop() { extra.map = &open_map(); }

  double stamp_now_s() const { return now_s + clock_offset_s; }

  GateResult tick(const PlannedTrajectory* plan = nullptr,
                  const MissionCommand* command = nullptr) {
    now_s += kTick_s;
    vehicle.stamp_s = vehicle_alive ? stamp_now_s() : vehicle.stamp_s;
    if (vehicle_alive) vehicle_at_s = now_s;
    if (autopilot_alive) autopilot_at_s = now_s;
    if (displaced) vehicle.position_enu_m = *displaced;
    GateInput in = extra;
    in.now_s = now_s;
    in.stamp_now_s = stamp_now_s();
    in.plan = plan;
    in.vehicle = vehicle;
    in.vehicle_at_s = vehicle_at_s;
    in.autopilot = autopilot.status;
    in.autopilot_at_s = autopilot_at_s;
    in.ack = autopilot.ack ? &*autopilot.ack : nullptr;
    in.command = command;
    result = gate(state, in, params);
    autopilot.take(result.request);
    if (result.setpoint) obey(*result.setpoint);
    return result;
  }
  GateResult run(double for_s) {
    for (int i = 0; i < static_cast<int>(for_s / kTick_s + 0.5); ++i) tick();
    return result;
  }
  /// With a planner that lets the vehicle stand.
  GateResult run_with_plans(double for_s) {
    for (int i = 0; i < static_cast<int>(for_s / kTick_s + 0.5); ++i) {
      const auto plan = still_plan(++last_plan, stamp_now_s() + kTick_s,
                                   displaced.value_or(vehicle.position_enu_m));
      tick(i % 5 == 0 ? &plan : nullptr);
    }
    return result;
  }
  GateResult order(MissionOrder what, const ShortText& who = "ada", bool proved = true) {
    const MissionCommand command{.id = ++last_order,
                                 .stamp_s = stamp_now_s(),
                                 .order = what,
                                 .operator_name = who,
                                 .lease_id = who,
                                 .proved = proved};
    return tick(nullptr, &command);
  }
  /// A ceiling, under the lease of whoever gives it.
  GateResult order_ceiling(double altitude_max_m, const ShortText& who = "ada") {
    MissionCommand command{.id = ++last_order,
                           .stamp_s = stamp_now_s(),
                           .order = MissionOrder::kSetBounds,
                           .operator_name = who,
                           .lease_id = who,
                           .proved = true};
    command.bounds.altitude_max_m = altitude_max_m;
    return tick(nullptr, &command);
  }
  /// On order, until it flies.
  void take_off_and_track() {
    order(MissionOrder::kStart);
    for (int i = 0; i < 300 && state.mission.phase != MissionPhase::kTracking; ++i)
      run_with_plans(kTick_s);
  }

 private:
  void obey(const Setpoint& s) {
    if (!s.position_enu_m.hasNaN()) vehicle.position_enu_m = s.position_enu_m;
    vehicle.velocity_enu_m_s = s.velocity_enu_m_s;
  }
};

}  // namespace foretrack::testing
