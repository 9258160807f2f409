// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/hub/light_picture.hpp"

#include "core/perception/shrink_image.hpp"
#include "sensor_msgs/msg/CompressedImage.h"
#include "services/common/raw.hpp"
#include "services/convert/compressed_image.hpp"
#include "services/convert/encode_jpeg.hpp"
#include "services/ground_station/hub/video_chain.hpp"

namespace foretrack::station {
namespace {

constexpr int kWidth_px = 320;
constexpr int kQuality = 40;

}  // namespace

bool can_be_lighter(const Channel& channel) {
  return is_ground_picture(channel) && channel.schema_name == "sensor_msgs/msg/CompressedImage";
}

std::shared_ptr<const Bytes> lighten(const Bytes& cdr) {
  const auto ops = type_ops<sensor_msgs::msg::CompressedImage>();
  sensor_msgs::msg::CompressedImage message;
  if (!from_cdr(ops, cdr, &message)) return nullptr;
  const auto image = rgb_of_any_size(message);
  if (!image) return nullptr;
  RgbImage small;
  shrink(*image, kWidth_px, small);
  encode_jpeg(small, kQuality, message.data());
  auto light = std::make_shared<const Bytes>(to_cdr(ops, &message));
  return message.data().empty() || light->size() >= cdr.size() ? nullptr : light;
}

const Sample& PerLink::light() {
  if (light_) return *light_;
  light_ = full_;
  if (auto data = can_be_lighter_ ? lighten(*full_.data) : nullptr) light_->data = std::move(data);
  return *light_;
}

}  // namespace foretrack::station
