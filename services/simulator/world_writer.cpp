// SPDX-License-Identifier: Apache-2.0
#include "services/simulator/world_writer.hpp"

#include "services/convert/bodies.hpp"
#include "services/convert/geometry.hpp"
#include "services/convert/image.hpp"
#include "services/convert/map.hpp"
#include "services/convert/px4.hpp"
#include "services/convert/px4_health.hpp"
#include "services/convert/target.hpp"
#include "services/convert/transforms.hpp"
#include "services/convert/vehicle.hpp"

namespace foretrack {
namespace {

constexpr int kStatusSteps = 20;  // 5 Hz, and at each change
constexpr int kFlagsSteps = 50;   // 2 Hz, and at each change
constexpr int kBatterySteps = 100;
constexpr int kTruthSteps = 2;  // 50 Hz
constexpr int kPositionSteps = 2;

bool same(const AutopilotStatus& a, const AutopilotStatus& b) {
  return a.armed == b.armed && a.mode == b.mode && a.failsafe == b.failsafe &&
         a.user_took_over == b.user_took_over;
}

VehicleState as_odometry(const PersonState& person) {
  return {.stamp_s = person.stamp_s,
          .position_enu_m = person.position_enu_m,
          .velocity_enu_m_s = person.velocity_enu_m_s,
          .q_world_body = Quat(Eigen::AngleAxisd(person.body_yaw_rad, Vec3::UnitZ()))};
}

}  // namespace

WorldWriter::WorldWriter(Node& node, const Scenario& scenario, const World& world)
    : body_frame_(node.options().names.frame(kBodyFrame)),
      camera_frame_(node.options().names.frame(kCameraFrame)),
      odometry_(node),
      px4_odometry_(node),
      px4_position_(node),
      px4_status_(node),
      px4_battery_(node),
      px4_home_(node),
      px4_flags_(node),
      px4_sticks_(node),
      depth_(node),
      camera_info_(node),
      color_(node),
      color_info_(node),
      target_truth_(node),
      vehicle_truth_(node),
      transforms_(node),
      mount_(node),
      map_(node) {
  if (!scenario.color_images) {
    observation_.emplace(node);
    sightings_.emplace(node);
  }
  to_transform(scenario.depth_camera.camera.T_body_camera, body_frame_, camera_frame_, 0.0,
               mount_.sample());
  mount_.write();
  if (scenario.map != MapSource::kKnown) return;
  to_idl(known_map(world, scenario.map_resolution_m), map_.sample());
  map_.write();
}

void WorldWriter::publish(const SimulatorOutput& out) {
  ++steps_;
  publish_vehicle(out);
  publish_autopilot(out);
  publish_cameras(out);
  if (every(kTruthSteps)) publish_truth(out);
}

void WorldWriter::publish_vehicle(const SimulatorOutput& out) {
  to_idl(out.vehicle, odometry_.sample(), body_frame_);
  odometry_.write();
  to_idl(out.vehicle, px4_odometry_.sample());
  px4_odometry_.write();
  if (!every(kPositionSteps)) return;
  to_idl(out.vehicle, px4_position_.sample());
  set_origin(kOriginOfWorlds, px4_position_.sample());
  px4_position_.write();
  if (transforms_.readers() == 0) return;
  to_transform(out.vehicle, body_frame_, transforms_.sample());
  transforms_.write();
}

void WorldWriter::publish_autopilot(const SimulatorOutput& out) {
  if (every(kBatterySteps)) {
    to_idl(out.battery.state(), out.now_s, px4_battery_.sample());
    px4_battery_.write();
    to_idl(kOriginOfWorlds, out.home_enu_m, out.now_s, px4_home_.sample());
    px4_home_.write();
  }
  const bool news = out.offboard_possible != offboard_possible_ || out.trouble != trouble_;
  if (news || every(kFlagsSteps)) {
    offboard_possible_ = out.offboard_possible;
    trouble_ = out.trouble;
    to_flags(out.now_s, out.offboard_possible, out.battery.state().warning, out.trouble,
             px4_flags_.sample());
    px4_flags_.write();
  }
  if (out.autopilot.sticks_moved) {
    px4_sticks_.sample().timestamp(static_cast<std::uint64_t>(1e6 * out.now_s));
    px4_sticks_.sample().valid(true);
    px4_sticks_.sample().sticks_moving(true);
    px4_sticks_.write();
  }
  if (same(out.autopilot, autopilot_) && !every(kStatusSteps)) return;
  autopilot_ = out.autopilot;
  to_idl(out.autopilot, px4_status_.sample());
  px4_status_.write();
}

void WorldWriter::publish_cameras(const SimulatorOutput& out) {
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

void WorldWriter::publish_truth(const SimulatorOutput& out) {
  to_idl(as_odometry(out.target), target_truth_.sample());
  target_truth_.write();
  to_idl(out.vehicle, vehicle_truth_.sample(), body_frame_);
  vehicle_truth_.write();
}

}  // namespace foretrack
