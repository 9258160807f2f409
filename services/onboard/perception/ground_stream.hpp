// SPDX-License-Identifier: Apache-2.0
// The camera's picture for people on the ground: small enough for their link.
#pragma once

#include <optional>

#include "core/common/image.hpp"
#include "core/perception/stream_pace.hpp"
#include "sensor_msgs/msg/CameraInfo.h"
#include "sensor_msgs/msg/CompressedImage.h"
#include "services/common/service.hpp"
#include "services/onboard/perception/picture_encoder.hpp"

namespace foretrack {

/// Writes camera/ground/image/compressed, and the camera_info that belongs to its size, both with
/// the image's stamp and frame. Its topics are there once there are images; nothing is encoded
/// while nobody reads them. The loop copies a picture and writes what is done: it never waits.
class GroundStream {
 public:
  GroundStream(Service& service, const StreamParams& params);

  /// An image that came, of the camera that `info` describes. Scaled and thinned as the parameters
  /// say.
  void offer(const RgbImage& image, const sensor_msgs::msg::CameraInfo& info, double stamp_s,
             const std::string& frame_id);

  /// Call it now and then in between: what is encoded goes out.
  void write_what_is_done();

 private:
  /// With the first image.
  struct Output {
    explicit Output(Node& node) : image(node), info(node) {}
    Writer<topics::GroundImage> image;
    Writer<topics::GroundCameraInfo> info;
    PictureEncoder encoder;
  };

  Service& service_;
  StreamParams params_;
  StreamPace pace_;
  sensor_msgs::msg::CameraInfo info_;  // of the full images
  std::optional<Output> output_;
  EncodedPicture picture_;
};

/// The calibration of the same camera for images of another size: what is in pixels is scaled.
/// Precondition: `in` was checked.
void scale_camera_info(const sensor_msgs::msg::CameraInfo& in, int width_px, int height_px,
                       sensor_msgs::msg::CameraInfo& out);

}  // namespace foretrack
