// SPDX-License-Identifier: Apache-2.0
#include "core/tracker/tracker.hpp"

#include <algorithm>
#include <utility>

#include "core/fleet/use_fleet.hpp"
#include "core/tracker/follow_people.hpp"

namespace foretrack {
namespace {

void take_part(TrackerState& state, const TrackerInput& input, const TrackerParams& params,
               TrackerOutput& out) {
  for (const FleetMember& message : input.fleet->heard)
    hear(state.fleet, message, input.now_s, params.fleet);
  if (input.now_s < state.next_fleet_s) return;
  state.next_fleet_s = input.now_s + kFleetPeriod_s - 1e-6;
  state.coordinated = coordinate(state.fleet,
                                 {.now_s = input.now_s,
                                  .vehicle = input.fleet->vehicle,
                                  .frame = input.fleet->frame,
                                  .state = input.vehicle,
                                  .radius_m = params.planning.body.hull_radius_m,
                                  .battery = input.fleet->battery,
                                  .flies = is_active(state.gate.mission.phase),
                                  .gap_min_m = params.planning.body.gap_min_m,
                                  .target = out.target,
                                  .prediction = &state.prediction.result.prediction,
                                  .intention = &state.prediction.result.intention,
                                  .plan = &state.planning.flown_result().trajectory,
                                  .map = out.map},
                                 params.fleet);
  out.fleet = &state.coordinated;
}

const GridMap* map_of(const TrackerState& state, const TrackerInput& input) {
  if (input.known_map) return input.known_map;
  return state.mapping.map.empty() ? nullptr : &state.mapping.map;
}

void observe(TrackerState& state, const TrackerInput& input, const PeopleTracks& people,
             const PeopleParams& params) {
  const TargetObservation& observation = *input.observation;
  state.delay_s = std::clamp(input.now_s - observation.stamp_s, 0.0, params.perception.delay_max_s);
  if (take_as_other(people, observation, state.vehicles, params)) return;
  perceive(state.perception, observation, state.vehicles, params.perception, input.torso_depth_m);
  if (!input.wears) return;
  state.bodies.followed_look.stamp_s = observation.stamp_s;
  state.bodies.followed_look.wears = input.wears;
}

// The gate takes the order in this step, and it acts in the next one.
void hear_order(TrackerState& state, const TrackerInput& input, const GateResult& gate) {
  const bool taken = input.command && input.command->order == MissionOrder::kFollow &&
                     gate.command_id == input.command->id && is_accepted(gate.command_result);
  if (taken) state.follow_order = input.command->person_id;
}

}  // namespace

TrackerState::TrackerState(const TrackerParams& params) : mapping(params.mapping) {}

TrackerOutput step(TrackerState& state, const TrackerInput& input, const TrackerParams& params) {
  TrackerOutput out;
  state.vehicles.add(input.vehicle);
  const PeopleTracks people{state.perception, state.bodies, state.choice};
  const PeopleParams people_params{params.perception, params.bodies, params.choice};
  if (input.observation) observe(state, input, people, people_params);
  out.target = coast(state.perception, input.now_s, params.perception);
  // A camera that is always late does not make the target a hidden one.
  out.target.status =
      track_status(state.perception, input.now_s - state.delay_s, params.perception);
  if (input.depth) {
    update_map(state.mapping, *input.depth, state.vehicles,
               bodies_at(input.depth->stamp_s, state.around, params.mapping), params.mapping);
    track_bodies(state.bodies, state.mapping.movers, out.target, params.bodies);
  }
  if (input.sightings)
    take_sightings(people, *input.sightings, input.looks, state.vehicles, people_params);
  out.map = map_of(state, input);

  if (input.fleet) {
    take_part(state, input, params, out);
    out.target = seen_by_any(out.target, state.coordinated.target, input.now_s);
  }

  const bool plans = out.map && input.now_s >= state.next_plan_s;
  if (plans) out.prediction = &predict(state.prediction, out.target, *out.map, params.prediction);
  const Followed followed{out.target, &state.prediction.result.prediction,
                          params.perception.target_height_m};
  bodies_around(state.bodies, input.now_s, followed, input.vehicle.position_enu_m, params.bodies,
                state.around, state.looks);
  out.bodies = &state.around;
  if (input.fleet) state.kept_clear = all_of(state.around, state.coordinated.peers, input.now_s);
  const MovingBodies* kept_clear = input.fleet ? &state.kept_clear : &state.around;
  const bool doubtful = input.observation && input.observation->doubtful;
  out.choice = choose_person(people,
                             {.now_s = input.now_s,
                              .bodies = state.around,
                              .looks = state.looks,
                              .vehicle_enu_m = input.vehicle.position_enu_m,
                              .doubtful = doubtful,
                              .order = std::exchange(state.follow_order, std::nullopt)},
                             people_params);

  const PlannedTrajectory* fresh = nullptr;
  if (plans) {
    state.next_plan_s = input.now_s + params.planning.horizon.plan_period_s - 1e-6;
    out.plan = &plan(
        state.planning,
        {.now_s = input.now_s,
         .vehicle = input.vehicle,
         .target = out.target,
         .intention = &out.prediction->intention,
         .prediction = &out.prediction->prediction,
         .map = out.map,
         .bodies = kept_clear,
         .flies_plans = state.gate.flies_plans,
         .framing = framing_of(state.gate.mission.framing, state.coordinated.place, params.fleet),
         .waits = out.choice.status == ChoiceStatus::kWaiting ||
                  out.choice.status == ChoiceStatus::kDoubtful},
        params.planning);
    out.planned = true;
    fresh = &out.plan->trajectory;
  }
  GateInput in;
  in.now_s = in.stamp_now_s = input.now_s;
  in.plan = fresh;
  in.vehicle = input.vehicle;
  in.vehicle_at_s = input.vehicle.stamp_s;
  in.autopilot = input.autopilot;
  in.autopilot_at_s = input.autopilot.stamp_s;
  in.command = input.command;
  in.map = out.map;
  in.map_at_s = input.now_s;
  in.bodies = kept_clear;
  in.bodies_at_s = input.now_s;
  out.gate = gate(state.gate, in, params.safety);
  hear_order(state, input, out.gate);
  return out;
}

}  // namespace foretrack
