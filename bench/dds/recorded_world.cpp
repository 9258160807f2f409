// SPDX-License-Identifier: Apache-2.0
#include "bench/dds/recorded_world.hpp"

#include "services/offline/flight/fly.hpp"

namespace foretrack {
namespace {

constexpr double kLook_s = 0.001;

TargetObservation truth_of(const PersonState& person) {
  return {.stamp_s = person.stamp_s,
          .kind = TargetObservation::Kind::kPosition,
          .camera = {},
          .position_enu_m = person.position_enu_m,
          .covariance_m2 = 1e-3 * Mat3::Identity(),
          .body_yaw_rad = person.body_yaw_rad,
          .body_yaw_variance_rad2 = 1e-2};
}

RecordedStep copy_of(const SimulatorOutput& out) {
  RecordedStep step{out, {}, {}};
  if (out.color) step.color = *out.color;
  if (out.depth) step.depth = *out.depth;
  return step;
}

// As if it had happened at begin_s.
void shift(RecordedStep& step, double begin_s) {
  SimulatorOutput& out = step.out;
  for (double* stamp_s :
       {&out.now_s, &out.vehicle.stamp_s, &out.autopilot.stamp_s, &out.target.stamp_s})
    *stamp_s += begin_s;
  if (step.color) step.color->stamp_s += begin_s;
  if (step.depth) step.depth->stamp_s += begin_s;
  out.color = step.color ? &*step.color : nullptr;
  out.depth = step.depth ? &*step.depth : nullptr;
}

}  // namespace

std::vector<RecordedStep> record_world(const Scenario& scenario) {
  const TrackerParams params;
  TrackerState tracker(params);
  std::vector<RecordedStep> steps;
  const Pilot pilot = [&](PilotStep s) {
    steps.push_back(copy_of(s.simulator));
    TrackerInput input{.now_s = s.simulator.now_s,
                       .vehicle = s.simulator.vehicle,
                       .autopilot = s.simulator.autopilot,
                       .depth = s.known_map ? nullptr : s.simulator.depth,
                       .known_map = s.known_map};
    const TargetObservation truth = truth_of(s.simulator.target);
    if (s.simulator.color) input.observation = &truth;
    const MissionCommand start{
        .id = 1, .stamp_s = s.simulator.now_s, .order = MissionOrder::kStart};
    if (steps.size() == 1) input.command = &start;
    s.command = input_of(step(tracker, input, params).gate);
  };
  fly_pilot(scenario, pilot, metric_params_of(params));
  return steps;
}

Replay::Replay(Service& service, const Scenario& scenario, std::vector<RecordedStep>& steps)
    : clock_(service.clock()),
      steps_(steps),
      writer_(service.node(), scenario, world_of(scenario)) {
  service.loop().every_wall(kLook_s, [this] { publish_due(); });
}

void Replay::publish_due() {
  const double begin_s = begin_s_, now_s = clock_.now_s();
  for (; next_ < steps_.size() && begin_s + steps_[next_].out.now_s <= now_s; ++next_) {
    shift(steps_[next_], begin_s);
    writer_.publish(steps_[next_].out);
  }
  over_ = next_ == steps_.size();
}

}  // namespace foretrack
