// SPDX-License-Identifier: Apache-2.0
#include "services/simulator/scene_writer.hpp"

#include "services/convert/bodies.hpp"
#include "services/convert/geometry.hpp"
#include "services/convert/image.hpp"
#include "services/convert/map.hpp"
#include "services/convert/target.hpp"
#include "services/convert/transforms.hpp"
#include "services/convert/vehicle.hpp"

namespace foretrack {
namespace {

VehicleState as_odometry(const PersonState& person) {
  return {.stamp_s = person.stamp_s,
          .position_enu_m = person.position_enu_m,
          .velocity_enu_m_s = person.velocity_enu_m_s,
          .q_world_body = Quat(Eigen::AngleAxisd(person.body_yaw_rad, Vec3::UnitZ()))};
}

}  // namespace

SceneWriter::SceneWriter(Node& node, const Scenario& scenario)
    : body_frame_(node.options().names.frame(kBodyFrame)),
      camera_frame_(node.options().names.frame(kCameraFrame)),
      depth_(node),
      camera_info_(node),
      color_(node),
      color_info_(node),
      target_truth_(node),
      vehicle_truth_(node),
      mount_(node),
      map_(node) {
  if (!scenario.color_images) {
    observation_.emplace(node);
    sightings_.emplace(node);
  }
  to_transform(scenario.depth_camera.camera.T_body_camera, body_frame_, camera_frame_, 0.0,
               mount_.sample());
  mount_.write();
}

void SceneWriter::publish_map(const Scenario& scenario, const World& world) {
  if (scenario.map != MapSource::kKnown) return;
  to_idl(known_map(world, scenario.map_resolution_m), map_.sample());
  map_.write();
}

void SceneWriter::publish_cameras(const SimulatorOutput& out) {
  if (out.observation) {
    to_idl(*out.observation, observation_->sample());
    observation_->write();
  }
  if (out.sightings && sightings_) {
    to_idl(*out.sightings, sightings_->sample());
    sightings_->write();
  }
  if (out.color) {
    to_idl(out.color->camera, out.color->stamp_s, color_info_.sample(), camera_frame_);
    color_info_.write();
    to_idl(out.color->pixels, out.color->stamp_s, color_.sample(), camera_frame_);
    color_.write();
  }
  if (!out.depth) return;
  to_idl(out.depth->camera, out.depth->stamp_s, camera_info_.sample(), camera_frame_);
  camera_info_.write();
  to_idl(*out.depth, depth_.sample(), camera_frame_);
  depth_.write();
}

void SceneWriter::publish_truth(const SimulatorOutput& out) {
  to_idl(as_odometry(out.target), target_truth_.sample());
  target_truth_.write();
  to_idl(out.vehicle, vehicle_truth_.sample(), body_frame_);
  vehicle_truth_.write();
}

}  // namespace foretrack
