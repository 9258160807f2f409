// SPDX-License-Identifier: Apache-2.0
// One replan taken apart: what its steps are given.
#pragma once

#include "core/planning/plan.hpp"
#include "core/planning/plan_task.hpp"
#include "core/planning/see/expect_bodies.hpp"
#include "tests/core/planning/plan_loop.hpp"
#include "tests/core/planning/planning_worlds.hpp"

namespace foretrack::testing {

/// A vehicle that hovers 2 m behind a target that walks along x.
struct OnePlan {
  World world = empty_world(10.0);
  GridMap map;
  PlanningParams params;
  PlanningState state;
  MovingBodies bodies;
  PlanInput input;
  StageClock clock;

  OnePlan() {
    input.now_s = 5.0;
    input.vehicle = hovering({-2.0, 0.0, 1.3}, 0.0, input.now_s);
    input.target.status = TrackStatus::kTracking;
    input.target.stamp_s = input.now_s;
    input.target.position_enu_m = {0.0, 0.0, 1.2};
    input.target.velocity_enu_m_s = {1.2, 0.0, 0.0};
    build_map();
    reserve(state);
  }
  void build_map() {
    map = known_map(world, 0.15);
    input.map = &map;
  }
  /// As if a plan had been made and flown until now.
  void fly() { plan(state, input, params); }
  /// Time goes on along what is flown.
  void wait(double dt_s) {
    input.now_s += dt_s;
    const PlannedTrajectory& flown = state.flown_result().trajectory;
    const double t_s = input.now_s - flown.start_s;
    input.vehicle.stamp_s = input.target.stamp_s = input.now_s;
    input.vehicle.position_enu_m = flown.position(t_s);
    input.vehicle.velocity_enu_m_s = flown.velocity(t_s);
    input.target.position_enu_m += dt_s * input.target.velocity_enu_m_s;
  }
  void add_body(const Vec3& foot, const Vec3& velocity) {
    MovingBody body;
    body.kind = BodyKind::kPerson;
    body.id = static_cast<std::uint32_t>(bodies.count + 1);
    body.stamp_s = input.now_s;
    body.position_enu_m = foot;
    body.velocity_enu_m_s = velocity;
    bodies.add(body);
    bodies.stamp_s = input.now_s;
    input.bodies = &bodies;
  }
  /// The task of a replan now; the target and everybody else are believed.
  PlanTask task(bool lost = false) {
    update_belief(state.belief, input.target, nullptr, params.horizon);
    expect_bodies(input, &state.belief, params.body, state.courses);
    return {input, params, params.limits,
            choose_start(state.flown_result().trajectory, input, params), lost};
  }
};

inline double end_speed_m_s(const PlannedTrajectory& trajectory) {
  return trajectory.velocity(trajectory.duration_s()).norm();
}

}  // namespace foretrack::testing
