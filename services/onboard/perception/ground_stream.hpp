// SPDX-License-Identifier: Apache-2.0
// The camera's picture for people on the ground: small enough for their link.
#pragma once

#include <optional>

#include "core/common/image.hpp"
#include "core/perception/stream_pace.hpp"
#include "foxglove_msgs/msg/CompressedVideo.h"
#include "sensor_msgs/msg/CameraInfo.h"
#include "sensor_msgs/msg/CompressedImage.h"
#include "services/common/service.hpp"
#include "services/onboard/perception/picture_encoder.hpp"

namespace foretrack {

/// Of the bandwidth, what each has that is read; `enabled` says whether it is. Of two the video has
/// the smaller part, as it needs less for the same picture.
struct StreamShares {
  StreamParams image, video;
};
StreamShares share_bandwidth(const StreamParams& params, bool image_is_read, bool video_is_read);

/// Writes camera/ground/image/compressed and, where it is built with an encoder,
/// camera/ground/video, and the camera_info that belongs to their size, all with the image's stamp
/// and frame. Its topics are there once there are images; neither is encoded while nobody reads it.
/// They share the bandwidth. The loop copies a picture and writes what is done: it never waits.
class GroundStream {
 public:
  /// The parameters must outlive it.
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
    explicit Output(Node& node);
    Writer<topics::GroundImage> image;
    std::optional<Writer<topics::GroundVideo>> video;  // none: without an encoder
    Writer<topics::GroundCameraInfo> info;
    PictureEncoder encoder;
  };
  /// What the picture shall be now; nothing: not wanted, or not due.
  PictureLabel label_at(double stamp_s, const std::string& frame_id);
  void write_image();
  void write_video();

  Service& service_;
  const StreamParams& params_;  // may change in flight
  StreamPace image_pace_, video_pace_;
  StreamShares shares_;
  sensor_msgs::msg::CameraInfo info_;  // of the full images
  std::optional<Output> output_;
  EncodedPicture picture_;
};

/// The calibration of the same camera for images of another size: what is in pixels is scaled.
/// Precondition: `in` was checked.
void scale_camera_info(const sensor_msgs::msg::CameraInfo& in, int width_px, int height_px,
                       sensor_msgs::msg::CameraInfo& out);

}  // namespace foretrack
