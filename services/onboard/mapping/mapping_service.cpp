// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/mapping/mapping_service.hpp"

#include "services/convert/bodies.hpp"
#include "services/convert/geometry.hpp"
#include "services/convert/image.hpp"
#include "services/convert/map.hpp"

namespace foretrack {
namespace {

// Found here, where all from_idl are declared.
constexpr auto convert = [](auto&& message) {
  return from_idl(std::forward<decltype(message)>(message));
};

const Fault kNoPose{"odometry", "no odometry of the image's stamp"};
constexpr double kMapPeriod_s = 0.1;
constexpr double kOthersPeriod_s = 1.0;
constexpr double kWatchPeriod_s = 0.1;
constexpr double kJitter_s = 0.02;  // of the images: 10 Hz out of 15 Hz is every second one or so

}  // namespace

MappingService::MappingService(Service& service, const MappingParams& params)
    : service_(service),
      params_(params),
      state_(params),
      vehicle_(service, [this] { update(); }),
      sight_(service, vehicle_),
      image_(service.node()),
      info_(service.node()),
      bodies_reader_(service.node()),
      transforms_(service),
      mount_(service, service.options().depth_mount, transforms_),
      map_(service.node()),
      sightings_(service.node()),
      octree_(service.node()),
      points_(service.node()) {
  Loop& loop = service.loop();
  loop.on_newest(info_, convert, [this](const CameraWithLens& camera) {
    if (!camera_ || !camera_->is(camera)) camera_.emplace(camera);
  });
  loop.on_newest(bodies_reader_, convert, [this](const MovingBodies& bodies) { bodies_ = bodies; });
  loop.on_newest(image_, [this](const auto& message) { take(message); });
  loop.every(kOthersPeriod_s, [this] { publish_for_others(); });
  loop.every(kWatchPeriod_s, [this] { watch(); });
}

void MappingService::take(const sensor_msgs::msg::Image& message) {
  arrived_s_ = service_.clock().now_s();
  if (!camera_) return image_.refuse(Fault{"camera_info", "no camera_info came yet"});
  if (waiting_) image_.refuse(what_is_missing());
  waiting_ = false;
  auto image = camera_->convert(message, std::move(depth_.depth_m));
  if (!image) return image_.refuse(image.fault());
  depth_ = std::move(*image);
  frame_id_ = message.header().frame_id();
  sight_.look_at_depth(depth_.depth_m);
  waiting_ = true;
  update();
}

// Of an image that waits, and that another one has overtaken.
Fault MappingService::what_is_missing() {
  return mount_.at(frame_id_, depth_.stamp_s) ? kNoPose : Fault{"mount", mount_.trouble()};
}

// An image may arrive before the odometry and the transforms of its stamp. False: they may come
// yet.
bool MappingService::place(const VehicleState* vehicle) {
  const auto mount = mount_.at(frame_id_, depth_.stamp_s);
  const bool covered = vehicle && vehicle->stamp_s >= depth_.stamp_s;
  if ((!covered || !mount) && service_.clock().now_s() - arrived_s_ < kPoseWait_s) return false;
  waiting_ = mount.has_value();
  if (mount)
    depth_.camera.T_body_camera = *mount;
  else
    image_.refuse(Fault{"mount", mount_.trouble()});
  return true;
}

void MappingService::update() {
  if (!waiting_ || !place(vehicle_.newest()) || !waiting_) return;
  waiting_ = false;
  const auto bodies = bodies_at(depth_.stamp_s, bodies_, params_);
  const auto result = update_map(state_, depth_, vehicle_.history(), bodies, params_);
  if (result.status != MapStatus::kUpdated) return image_.refuse(kNoPose);
  to_idl(state_.movers, sightings_.sample());
  sightings_.write();
  publish();
}

void MappingService::publish() {
  if (std::abs(depth_.stamp_s - published_s_) < kMapPeriod_s - kJitter_s) return;
  published_s_ = depth_.stamp_s;
  to_idl(state_.map, map_.sample());
  map_.sample().camera(static_cast<std::uint8_t>(sight_.fault()));
  map_.write();
}

void MappingService::publish_for_others() {
  if (state_.map.empty()) return;
  if (octree_.readers() > 0) {
    to_idl(*state_.tree, state_.map.stamp_s, octree_.sample());
    octree_.write();
  }
  if (points_.readers() > 0) {
    to_points(state_.map, points_.sample());
    points_.write();
  }
}

void MappingService::watch() {
  transforms_.update();
  update();
  const double now_s = service_.clock().now_s();
  const bool seeing = now_s - arrived_s_ < params_.image_stale_s;
  const bool placed = vehicle_.age_s(now_s) < params_.vehicle_stale_s;
  const std::string blind = sight_.trouble("depth");
  service_.health().set_degraded(!seeing          ? "no depth images"
                                 : !camera_       ? "no camera_info"
                                 : !placed        ? "no odometry"
                                 : !blind.empty() ? blind
                                                  : mount_.trouble());
}

void run_mapping(const ServiceOptions& options, const MappingParams& params, Stop& stop) {
  Service service("mapping", options, stop);
  service.show("mapping", params);
  MappingService stage(service, params);
  service.run();
}

}  // namespace foretrack
