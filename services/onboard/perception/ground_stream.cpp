// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/perception/ground_stream.hpp"

#include "services/convert/geometry.hpp"

namespace foretrack {
namespace {

constexpr double kLook_s = 0.01;  // for what the encoder has done

}  // namespace

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
  if (output_->image.readers() == 0 || !is_due(pace_, stamp_s, params_)) return;
  info_ = info;
  output_->encoder.give(image, {stamp_s, frame_id, params_.width_px, quality_of(pace_, params_)});
}

void GroundStream::write_what_is_done() {
  if (!output_ || !output_->encoder.take(picture_)) return;
  const auto& [label, width_px, height_px, jpeg] = picture_;
  scale_camera_info(info_, width_px, height_px, output_->info.sample());
  set_header(output_->info.sample().header(), label.stamp_s, label.frame_id);
  output_->info.write();
  auto& message = output_->image.sample();
  set_header(message.header(), label.stamp_s, label.frame_id);
  message.format("jpeg");
  message.data().assign(jpeg.begin(), jpeg.end());
  output_->image.write();
  sent(pace_, label.stamp_s, static_cast<double>(jpeg.size()), params_);
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
