// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/perception/image_input.hpp"

#include <cmath>
#include <limits>
#include <type_traits>

#include "core/perception/expected_place.hpp"
#include "core/perception/torso_depth.hpp"
#include "core/perception/undistort_person.hpp"
#include "core/perception/watch_others.hpp"
#include "services/convert/compressed_image.hpp"
#include "services/convert/geometry.hpp"
#include "services/convert/image.hpp"
#include "services/files/models/pose_models.hpp"

namespace foretrack {
namespace {

constexpr double kLoadAgain_s = 5.0;

}  // namespace

ImageInput::ImageInput(Service& service, const PerceptionParams& params, const StreamParams& stream,
                       const PerceptionState& track, const VehicleInput& vehicle, OnSeen seen,
                       OnPeople people)
    : service_(service),
      params_(params),
      track_(track),
      vehicle_(vehicle),
      sight_(service, vehicle),
      seen_(std::move(seen)),
      people_seen_(std::move(people)),
      transforms_(service),
      mount_(service, service.options().color_mount, transforms_),
      info_(service.node()),
      image_(service.node()),
      compressed_(service.node()),
      ground_(service, stream) {
  Loop& loop = service.loop();
  loop.on_newest(info_, [this](const auto& message) {
    const auto camera = from_idl(message);
    if (!camera) return info_.refuse(camera.fault());
    camera_ = *camera;
    camera_info_ = message;
  });
  loop.on_newest(image_, [this](const auto& message) { take(message, image_); });
  // A driver that writes both kinds: the plain ones are enough.
  loop.on_newest(compressed_, [this](const auto& message) {
    if (image_.writers() == 0) take(message, compressed_);
  });
}

template <class Message, class Topic>
void ImageInput::take(const Message& message, Reader<Topic>& reader) {
  const double stamp_s = seconds(message.header().stamp());
  if (service_.clock().now_s() - stamp_s > params_.image_stale_s) return reader.reject("late");
  if constexpr (std::is_same_v<Message, sensor_msgs::msg::Image>)
    sight_.look_at_color(message.data());
  if (!camera_) return reader.refuse(Fault{"camera_info", "no camera_info came yet"});
  auto image = rgb_from_idl(message, camera_->camera, std::move(rgb_.rgb));
  if (!image) return reader.refuse(image.fault());
  rgb_ = std::move(*image);
  if constexpr (!std::is_same_v<Message, sensor_msgs::msg::Image>) sight_.look_at_color(rgb_.rgb);
  ground_.offer(rgb_, camera_info_, stamp_s, message.header().frame_id());
  if (!load_network()) return reader.reject("no pose network");
  if (!place(message.header().frame_id(), stamp_s))
    return reader.refuse(Fault{"mount", mount_.trouble()});
  look(message.header().frame_id(), stamp_s);
}

bool ImageInput::place(const std::string& frame_id, double stamp_s) {
  const auto mount = mount_.at(frame_id, stamp_s);
  if (mount) camera_->camera.T_body_camera = *mount;
  return mount.has_value();
}

bool ImageInput::load_network() {
  const double now_s = service_.clock().now_s();
  if (network_ || std::abs(now_s - next_load_s_) < kLoadAgain_s) return network_.has_value();
  next_load_s_ = now_s;
  try {
    network_ = load_shipped_pose_network(params_.model_complexity);
    depth_info_.emplace(service_.node());
    depth_image_.emplace(service_.node());
    service_.node().announce();
    trouble_.clear();
  } catch (const std::exception& error) {
    if (trouble_ != error.what()) service_.node().report(error.what());
    trouble_ = error.what();
  }
  return network_.has_value();
}

void ImageInput::look(const std::string& frame_id, double stamp_s) {
  const auto expected =
      expected_place(track_, vehicle_.history(), camera_->camera, stamp_s, params_);
  PoseResult result = perceive_image(pose_, rgb_, stamp_s, *network_, params_, expected);
  ground_.write_what_is_done();  // encoded meanwhile
  if (result.ambiguous) ambiguous_s_ = stamp_s;
  image_s_ = stamp_s;
  place(frame_id, stamp_s);  // once more: a joint's transform of this time may have come meanwhile
  Seen seen{stamp_s, nullptr, std::numeric_limits<double>::quiet_NaN(), result.wears};
  if (result.found()) {
    undistort(result.person, camera_->camera, camera_->lens);
    observation_ = to_observation(result.person, stamp_s, camera_->camera, params_);
    observation_.doubtful = result.ambiguous;
    seen.observation = &observation_;
    seen.torso_depth_m = torso_depth_m(observation_);
  }
  seen_(seen);
  auto others = watch_others(pose_, rgb_, stamp_s, *network_, params_);
  for (OtherPerson& other : others)
    if (other.pose) undistort(*other.pose, camera_->camera, camera_->lens);
  sight_people(others, stamp_s, camera_->camera, vehicle_.history(), params_, people_);
  people_seen_(people_);
}

double ImageInput::torso_depth_m(const TargetObservation& observation) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const auto camera = depth_info_->take_newest_as(
      [](const sensor_msgs::msg::CameraInfo& message) { return from_idl(message); });
  if (camera && (!depth_camera_ || !depth_camera_->is(*camera))) depth_camera_.emplace(*camera);
  if (!depth_camera_) return kNone;
  auto depth = depth_image_->take_newest_as([this](const sensor_msgs::msg::Image& message) {
    return depth_camera_->convert(message, std::move(depth_.depth_m));
  });
  if (depth) depth_ = std::move(*depth);
  if (std::abs(depth_.stamp_s - observation.stamp_s) > params_.same_instant_s) return kNone;
  return torso_surface_depth_m(observation, depth_).value_or(kNone);
}

}  // namespace foretrack
