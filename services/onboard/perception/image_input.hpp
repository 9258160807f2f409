// SPDX-License-Identifier: Apache-2.0
// Colour and depth images in, observations of the person out.
#pragma once

#include <functional>
#include <optional>

#include "core/perception/perceive.hpp"
#include "core/perception/perceive_image.hpp"
#include "core/perception/sight_people.hpp"
#include "core/tracker/follow_people.hpp"
#include "sensor_msgs/msg/CameraInfo.h"
#include "sensor_msgs/msg/CompressedImage.h"
#include "sensor_msgs/msg/Image.h"
#include "services/convert/color_image.hpp"
#include "services/convert/depth_reader.hpp"
#include "services/onboard/camera_mount.hpp"
#include "services/onboard/camera_sight.hpp"
#include "services/onboard/inputs.hpp"
#include "services/onboard/perception/ground_stream.hpp"

namespace foretrack {

/// The pose network is loaded when the first image comes. Without its files images are refused, and
/// trouble() says how to get them; they are looked for again every few seconds. Only the newest
/// image is looked at, and none that is older than the parameter image_stale_s.
class ImageInput {
 public:
  /// What one image says; `observation` is none if nobody is in it.
  struct Seen {
    double stamp_s = 0.0;
    const TargetObservation* observation = nullptr;
    double torso_depth_m = 0.0;            // NaN: not measured
    std::optional<Appearance> wears = {};  // the person; none: not seen
  };
  using OnSeen = std::function<void(const Seen&)>;
  using OnPeople = std::function<void(const PeopleSeen&)>;

  /// At each image `seen` is called, and then `people`, with all others. `track` and `vehicle` say
  /// where the person is expected; they outlive this. Each image goes to the ground, too, also one
  /// that the network cannot look at.
  ImageInput(Service& service, const PerceptionParams& params, const StreamParams& stream,
             const PerceptionState& track, const VehicleInput& vehicle, OnSeen seen,
             OnPeople people);

  /// Why images are of no use now; empty: they are, or none come.
  const std::string& trouble() const { return trouble_; }
  /// Why it is a guess where the camera sits; empty: it is known, or no images come.
  const std::string& mount_trouble() const { return mount_.trouble(); }
  /// Transforms come between images, too.
  void update() { transforms_.update(); }
  /// Whether the images still show something, and why not.
  const CameraSight& sight() const { return sight_; }
  /// Somebody else is followed from now on, who wears that; see follow_other().
  void follow(const std::optional<Appearance>& wears) { follow_other(pose_, wears); }
  void follow_nobody() { pose_.follows = false; }
  /// Who is followed first where several are seen.
  void start_with(const ChoiceParams& params) { begin_with(pose_, params); }
  /// The last image that was looked at, and its stamp; null: there was none.
  const RgbImage* image() const { return image_s_ < 0.0 ? nullptr : &rgb_; }
  double image_s() const { return image_s_; }
  /// When several people could last have been the one who is followed; by the image's stamp.
  double ambiguous_s() const { return ambiguous_s_; }

 private:
  template <class Message, class Topic>
  void take(const Message& message, Reader<Topic>& reader);
  bool load_network();
  bool place(const std::string& frame_id, double stamp_s);
  void look(const std::string& frame_id, double stamp_s);
  double torso_depth_m(const TargetObservation& observation);

  Service& service_;
  PerceptionParams params_;
  const PerceptionState& track_;
  const VehicleInput& vehicle_;
  CameraSight sight_;
  OnSeen seen_;
  OnPeople people_seen_;
  TransformInput transforms_;
  CameraMount mount_;
  Reader<topics::ColorCameraInfo> info_;
  Reader<topics::ColorImage> image_;
  Reader<topics::ColorImageCompressed> compressed_;
  // Only where there are colour images: depth images are big.
  std::optional<Reader<topics::DepthCameraInfo>> depth_info_;
  std::optional<Reader<topics::DepthImage>> depth_image_;
  std::optional<CameraWithLens> camera_;
  sensor_msgs::msg::CameraInfo camera_info_;  // that says so
  std::optional<DepthReader> depth_camera_;
  std::optional<PoseNetwork> network_;
  PoseState pose_;
  RgbImage rgb_;
  GroundStream ground_;
  DepthImage depth_;
  TargetObservation observation_;
  PeopleSeen people_;
  std::string trouble_;
  double next_load_s_ = -1e9;
  double ambiguous_s_ = -1e9;
  double image_s_ = -1.0;
};

}  // namespace foretrack
