// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/fly.hpp"

#include <limits>
#include <utility>

#include "core/safety/command_of.hpp"
#include "services/common/time_now.hpp"
#include "services/files/share/share.hpp"
#include "services/offline/flight/camera_eye.hpp"

namespace foretrack {
namespace {

// The path's point at a time; NaN beyond its end.
Vec2 point_at(const PredictedPath& path, double time_s) {
  if (path.states.empty() || time_s > path.states.back().time_s + 1e-9)
    return Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
  return path.at(time_s).position_enu_m.head<2>();
}

// What was last predicted and planned stays in the rows until the next plan.
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

// An operator who starts the flight, and orders what the scenario says, each under a lease that is
// taken for it.
class SteadyOperator {
 public:
  explicit SteadyOperator(const Scenario& scenario) : orders_(scenario.orders) {}

  /// Null: nothing is ordered now.
  const MissionCommand* order(double now_s) {
    command_ = {.id = command_.id + 1, .stamp_s = now_s, .lease_id = "lease", .proved = true};
    if (command_.id == 1) return &command_;  // start
    if (next_ == orders_.size() || now_s < orders_[next_].at_s) return nullptr;
    command_.order = MissionOrder::kLease;
    if (std::exchange(has_lease_, !has_lease_)) take(orders_[next_++]);
    return &command_;
  }

 private:
  void take(const OperatorOrder& order) {
    command_.order = order.follow ? MissionOrder::kFollow : MissionOrder::kSetFraming;
    command_.person_id = order.follow.value_or(0);
    command_.framing = order.framing;
  }

  const std::vector<OperatorOrder>& orders_;
  std::size_t next_ = 0;
  bool has_lease_ = false;
  MissionCommand command_;
};

}  // namespace

MetricParams metric_params_of(const TrackerParams& params) {
  const PlanningParams& p = params.planning;
  return {.band_low_m = p.place.distance_low_m,
          .band_high_m = p.place.distance_high_m,
          .speed_max_m_s = p.limits.speed_max_m_s,
          .acceleration_max_m_s2 = p.limits.acceleration_max_m_s2,
          .yaw_rate_max_rad_s = p.limits.yaw_rate_max_rad_s,
          .height_above_target_m = p.place.height_above_target_m};
}

AutopilotInput input_of(const GateResult& gate) {
  AutopilotInput command;
  command.heartbeat = gate.heartbeat;
  command.setpoint = gate.setpoint;
  command.command = command_of(gate.request, 1);
  return command;
}

FlightResult fly(const Scenario& scenario, const TrackerParams& params,
                 const FlightOptions& options, const TrackerWatch& watch) {
  TrackerState tracker(params);
  std::optional<CameraEye> eye;
  if (scenario.color_images)
    eye.emplace(load_pose_network(find_share("models"),
                                  static_cast<PoseModel>(params.perception.model_complexity)),
                params.perception, static_cast<FirstChoice>(params.choice.start),
                scenario.landmark_camera.delay_s);
  FlightRow last;
  SteadyOperator steady_operator(scenario);
  const Pilot pilot = [&](PilotStep s) {
    TrackerInput input{.now_s = s.simulator.now_s,
                       .vehicle = s.simulator.vehicle,
                       .autopilot = s.simulator.autopilot,
                       .observation = s.simulator.observation ? &*s.simulator.observation : nullptr,
                       .depth = s.known_map ? nullptr : s.simulator.depth,
                       .known_map = s.known_map,
                       .sightings = s.simulator.sightings ? &*s.simulator.sightings : nullptr};
    if (const auto* seen =
            eye ? eye->look(s.simulator, tracker.perception, tracker.vehicles) : nullptr) {
      if (seen->found) input.observation = &seen->observation;
      input.torso_depth_m = seen->torso_depth_m;
      input.wears = seen->wears;
      input.sightings = &seen->others.sightings;
      input.looks = seen->others.looks;
    }
    input.command = steady_operator.order(s.simulator.now_s);
    const double begin_ms = cpu_ms();  // other flights run beside this one
    const TrackerOutput out = step(tracker, input, params);
    if (eye && out.choice.take_over)
      *out.choice.take_over == 0 ? eye->follow_nobody() : eye->follow(tracker.choice.wears);
    if (out.planned) s.plan_ms.push_back(cpu_ms() - begin_ms);
    if (watch) watch(out);
    s.command = input_of(out.gate);
    write_decision(out, last, s.row);
  };
  return fly_pilot(scenario, pilot, metric_params_of(params), options);
}

}  // namespace foretrack
