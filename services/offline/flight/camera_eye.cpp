// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/camera_eye.hpp"

#include "core/perception/expected_place.hpp"
#include "core/perception/torso_depth.hpp"
#include "core/perception/watch_others.hpp"

namespace foretrack {
namespace {

double torso_depth_of(const TargetObservation& observation, const DepthImage* depth,
                      double same_instant_s) {
  const bool fits = depth && std::abs(depth->stamp_s - observation.stamp_s) <= same_instant_s;
  const auto surface_m = fits ? torso_surface_depth_m(observation, *depth) : std::nullopt;
  return surface_m.value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

const CameraEye::Seen* CameraEye::look(const SimulatorOutput& output, const PerceptionState& track,
                                       const VehicleHistory& vehicles) {
  if (const ColorImage* image = output.color) {
    const auto expected = expected_place(track, vehicles, image->camera, image->stamp_s, params_);
    result_ = perceive_image(state_, image->pixels, image->stamp_s, network_, params_, expected);
    Seen& seen = waiting_.emplace_back();
    seen.observation.stamp_s = image->stamp_s;
    seen.found = result_.found();
    if (seen.found) {
      seen.observation = to_observation(result_.person, image->stamp_s, image->camera, params_);
      seen.observation.doubtful = result_.ambiguous;
      seen.wears = result_.wears;
      seen.torso_depth_m = torso_depth_of(seen.observation, output.depth, params_.same_instant_s);
    }
    const auto others = watch_others(state_, image->pixels, image->stamp_s, network_, params_);
    sight_people(others, image->stamp_s, image->camera, vehicles, params_, seen.others);
  }
  if (waiting_.empty() || output.now_s < waiting_.front().observation.stamp_s + delay_s_ - 1e-9)
    return nullptr;
  delivered_ = waiting_.front();
  waiting_.pop_front();
  return &delivered_;
}

}  // namespace foretrack
