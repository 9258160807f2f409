// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/tracker_pilot.hpp"

#include <limits>

#include "core/safety/command_of.hpp"
#include "services/common/time_now.hpp"
#include "services/files/share/share.hpp"

namespace foretrack {
namespace {

// The path's point at a time; NaN beyond its end.
Vec2 point_at(const PredictedPath& path, double time_s) {
  if (path.states.empty() || time_s > path.states.back().time_s + 1e-9)
    return Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
  return path.at(time_s).position_enu_m.head<2>();
}

void write_plan(const TrackerOutput& out, FlightRow& last) {
  last.planned = out.planned;
  if (!out.planned) return;
  last.beliefs = out.prediction->intention.beliefs;
  last.foresight_m = no_foresight();
  const auto& paths = out.prediction->prediction.paths;
  if (!paths.empty())
    for (std::size_t i = 0; i < kForesight_s.size(); ++i)
      last.foresight_m[i] = point_at(paths.front(), kForesight_s[i]);
  last.plan_status = out.plan->trajectory.status;
  last.plan_reason = out.plan->trajectory.reason;
  last.plan_id = out.plan->trajectory.id;
}

void write_decision(const TrackerOutput& out, FlightRow& last, FlightRow& row) {
  write_plan(out, last);
  row.planned = last.planned;
  row.beliefs = last.beliefs;
  row.foresight_m = last.foresight_m;
  row.plan_status = last.plan_status;
  row.plan_reason = last.plan_reason;
  row.plan_id = last.plan_id;
  row.estimate = out.target;
  row.mode = to_string(out.gate.mode);
  row.setpoint = out.gate.setpoint;
}

}  // namespace

AutopilotInput input_of(const GateResult& gate) {
  AutopilotInput command;
  command.heartbeat = gate.heartbeat;
  command.setpoint = gate.setpoint;
  command.command = command_of(gate.request, 1);
  return command;
}

TrackerPilot::TrackerPilot(const Scenario& scenario, const TrackerParams& params)
    : params_(params), tracker_(params), operator_(scenario) {
  if (scenario.color_images)
    eye_.emplace(load_pose_network(find_share("models"),
                                   static_cast<PoseModel>(params.perception.model_complexity)),
                 params.perception, params.choice, scenario.landmark_camera.delay_s);
}

TrackerOutput TrackerPilot::fly(PilotStep s, const FleetLink* fleet, const MissionCommand* order) {
  TrackerInput input{.now_s = s.simulator.now_s,
                     .vehicle = s.simulator.vehicle,
                     .autopilot = s.simulator.autopilot,
                     .observation = s.simulator.observation ? &*s.simulator.observation : nullptr,
                     .depth = s.known_map ? nullptr : s.simulator.depth,
                     .known_map = s.known_map,
                     .sightings = s.simulator.sightings ? &*s.simulator.sightings : nullptr,
                     .command = operator_.order(s.simulator.now_s),
                     .fleet = fleet};
  if (const auto* seen =
          eye_ ? eye_->look(s.simulator, tracker_.perception, tracker_.vehicles) : nullptr) {
    if (seen->found) input.observation = &seen->observation;
    input.torso_depth_m = seen->torso_depth_m;
    input.wears = seen->wears;
    input.sightings = &seen->others.sightings;
    input.looks = seen->others.looks;
  }
  if (order) input.command = order;
  const double begin_ms = cpu_ms();  // other flights run beside this one
  const TrackerOutput out = step(tracker_, input, params_);
  if (eye_ && out.choice.take_over)
    *out.choice.take_over == 0 ? eye_->follow_nobody() : eye_->follow(tracker_.choice.wears);
  if (out.planned) s.plan_ms.push_back(cpu_ms() - begin_ms);
  s.command = input_of(out.gate);
  write_decision(out, last_, s.row);
  return out;
}

}  // namespace foretrack
