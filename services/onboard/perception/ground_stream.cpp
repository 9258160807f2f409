// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/perception/ground_stream.hpp"

#include "services/convert/geometry.hpp"

namespace foretrack {
namespace {

constexpr double kLook_s = 0.01;       // for what the encoder has done
constexpr double kVideoOfBoth = 0.35;  // of the bandwidth, where the images are read as well

}  // namespace

GroundStream::Output::Output(Node& node) : image(node), info(node) {
  if (has_video_encoder()) video.emplace(node);
}

GroundStream::GroundStream(Service& service, const StreamParams& params)
    : service_(service), params_(params) {
  if (params_.enabled) service.loop().every_wall(kLook_s, [this] { write_what_is_done(); });
}

void GroundStream::offer(const RgbImage& image, const sensor_msgs::msg::CameraInfo& info,
                         double stamp_s, const std::string& frame_id) {
  if (!params_.enabled) return;
  if (!output_) {
    output_.emplace(service_.node());
    service_.node().announce();
  }
  write_what_is_done();
  const PictureLabel label = label_at(stamp_s, frame_id);
  if (!label.jpeg_quality && !label.video) return;
  info_ = info;
  output_->encoder.give(image, label);
}

PictureLabel GroundStream::label_at(double stamp_s, const std::string& frame_id) {
  const int viewers = output_->video ? output_->video->readers() : 0;
  shares_ = share_bandwidth(params_, output_->image.readers() > 0, viewers > 0);
  const auto& [image, video] = shares_;
  PictureLabel label{stamp_s, frame_id, params_.width_px};
  if (is_due(video_pace_, stamp_s, video))
    label.video = VideoWish{stamp_s, video.bandwidth_kbit_s, video.rate_hz, viewers};
  const bool in_step = !video.enabled || label.video;  // so that one image serves both
  if (in_step && is_due(image_pace_, stamp_s, image))
    label.jpeg_quality = quality_of(image_pace_, image);
  return label;
}

void GroundStream::write_what_is_done() {
  if (!output_ || !output_->encoder.take(picture_)) return;
  auto& info = output_->info.sample();
  scale_camera_info(info_, picture_.width_px, picture_.height_px, info);
  set_header(info.header(), picture_.label.stamp_s, picture_.label.frame_id);
  output_->info.write();
  if (!picture_.jpeg.empty()) write_image();
  if (!picture_.video.empty()) write_video();
}

void GroundStream::write_image() {
  auto& message = output_->image.sample();
  set_header(message.header(), picture_.label.stamp_s, picture_.label.frame_id);
  message.format("jpeg");
  message.data().assign(picture_.jpeg.begin(), picture_.jpeg.end());
  output_->image.write();
  sent(image_pace_, picture_.label.stamp_s, static_cast<double>(picture_.jpeg.size()),
       shares_.image);
}

void GroundStream::write_video() {
  auto& message = output_->video->sample();
  message.timestamp(to_time(picture_.label.stamp_s));
  message.frame_id(picture_.label.frame_id);
  message.format("h264");
  message.data().assign(picture_.video.begin(), picture_.video.end());
  output_->video->write();
  sent(video_pace_, picture_.label.stamp_s, static_cast<double>(picture_.video.size()),
       shares_.video);
}

StreamShares share_bandwidth(const StreamParams& params, bool image_is_read, bool video_is_read) {
  StreamShares shares{params, params};
  shares.image.enabled = params.enabled && image_is_read;
  shares.video.enabled = params.enabled && video_is_read;
  if (!image_is_read || !video_is_read) return shares;
  shares.image.bandwidth_kbit_s *= 1.0 - kVideoOfBoth;
  shares.video.bandwidth_kbit_s *= kVideoOfBoth;
  return shares;
}

void scale_camera_info(const sensor_msgs::msg::CameraInfo& in, int width_px, int height_px,
                       sensor_msgs::msg::CameraInfo& out) {
  out = in;
  const double across = 1.0 * width_px / in.width(), down = 1.0 * height_px / in.height();
  out.width(static_cast<std::uint32_t>(width_px));
  out.height(static_cast<std::uint32_t>(height_px));
  for (int column = 0; column < 3; ++column) {
    out.k()[column] *= across;
    out.k()[3 + column] *= down;
  }
  for (int column = 0; column < 4; ++column) {
    out.p()[column] *= across;
    out.p()[4 + column] *= down;
  }
  out.roi({});
  out.binning_x(0);
  out.binning_y(0);
}

}  // namespace foretrack
