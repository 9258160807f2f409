// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/clip/make_clip.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include "sensor_msgs/msg/CompressedImage.h"
#include "services/common/raw.hpp"
#include "services/common/topics.hpp"
#include "services/convert/compressed_image.hpp"
#include "services/convert/geometry.hpp"
#include "services/ground_station/bus/contract.hpp"
#include "services/ground_station/clip/vp8_encoder.hpp"
#include "services/ground_station/clip/webm.hpp"
#include "services/ground_station/mcap/reader.hpp"

namespace foretrack::station {
namespace {

constexpr std::int64_t kLast_ms = 66;  // how long the last picture is shown
constexpr int kLeastPx = 2;

/// Pictures in, one video out; it has the size of the first.
class Film {
 public:
  void add(const RgbImage& image, double stamp_s) {
    to_i420(image, picture_);
    if (picture_.width_px < kLeastPx || picture_.height_px < kLeastPx) return leave_out();
    if (!reel_) reel_.emplace(picture_.width_px, picture_.height_px, stamp_s);
    const auto time_ms = std::llround(1e3 * (stamp_s - reel_->begin_s));
    const bool fits =
        picture_.width_px == reel_->width_px && picture_.height_px == reel_->height_px;
    if (!fits || time_ms <= reel_->last_ms) return leave_out();
    const auto encoded = reel_->encoder.encode(picture_, time_ms);
    reel_->webm.add(time_ms, encoded.key, encoded.bytes);
    reel_->last_ms = time_ms;
    ++pictures_;
  }
  void leave_out() { ++left_out_; }
  bool is_empty() const { return pictures_ == 0; }
  Clip finish(const std::string& vehicle) const {
    return {vehicle, reel_->webm.finish(kLast_ms), pictures_, left_out_,
            1e-3 * static_cast<double>(reel_->last_ms + kLast_ms)};
  }

 private:
  struct Reel {
    Reel(int width, int height, double stamp_s)
        : width_px(width), height_px(height), begin_s(stamp_s) {}
    int width_px, height_px;
    double begin_s;
    std::int64_t last_ms = -1;
    Vp8Encoder encoder{width_px, height_px};
    WebmWriter webm{width_px, height_px};
  };
  I420Image picture_;
  std::optional<Reel> reel_;
  int pictures_ = 0, left_out_ = 0;
};

/// When, from the recording's beginning, a vehicle's pictures came.
struct Span {
  double first_s = 0.0, last_s = 0.0;
};

class Cutter {
 public:
  Cutter(const std::filesystem::path& file, const ClipWish& wish)
      : reader_(file), wish_(wish), vehicle_(wish.vehicle) {}

  Clip cut() {
    while (const auto message = reader_.next()) take(*message);
    if (!film_.is_empty()) return film_.finish(vehicle_);
    throw std::runtime_error(why_empty());
  }

 private:
  void take(const mcap::Message& message) {
    const double time_s = 1e-9 * static_cast<double>(message.log_time_ns);
    if (!begin_s_) begin_s_ = time_s;
    const std::string vehicle = vehicle_with_pictures(message.channel);
    if (vehicle.empty()) return;
    const double at_s = time_s - *begin_s_;
    auto& span = spans_.try_emplace(vehicle, Span{at_s, at_s}).first->second;
    span.last_s = at_s;
    if (at_s < wish_.from_s || at_s > wish_.to_s) return;
    if (vehicle_.empty()) vehicle_ = vehicle;
    if (wish_.vehicle.empty() && vehicle != vehicle_)
      throw std::runtime_error(
          fmt::format("{} and {} have pictures: say which vehicle", vehicle_, vehicle));
    if (vehicle == vehicle_) add(message, at_s);
  }

  void add(const mcap::Message& message, double at_s) {
    if (film_.is_empty()) first_s_ = at_s;
    if (at_s - first_s_ > kLongestClip_s)
      throw std::runtime_error(
          fmt::format("a clip is at most {:.0f} s long: say from when to when", kLongestClip_s));
    bytes_.assign(message.data.begin(), message.data.end());
    if (!from_cdr(type_ops<sensor_msgs::msg::CompressedImage>(), bytes_, &image_))
      return film_.leave_out();
    auto picture = rgb_of_any_size(image_, std::move(picture_.rgb));
    if (!picture) return film_.leave_out();
    picture_ = std::move(*picture);
    film_.add(picture_, seconds(image_.header().stamp()));
  }

  // Empty: this is not one's picture.
  std::string vehicle_with_pictures(std::uint16_t channel) {
    const auto known = vehicles_.find(channel);
    if (known != vehicles_.end()) return known->second;
    const auto& about = reader_.channels().at(channel).metadata;
    const auto wire = about.find("dds_topic");
    const ContractTopic* topic = wire == about.end() ? nullptr : contract_of(wire->second);
    const bool is_picture = topic && topic->name == topics::GroundImage::info.name;
    return vehicles_[channel] = is_picture ? std::string(vehicle_of(wire->second)) : "";
  }

  std::string why_empty() const {
    if (spans_.empty()) return "there are no pictures in it";
    const auto it = spans_.find(wish_.vehicle);
    std::string there;
    for (const auto& [vehicle, span] : spans_)
      if (it == spans_.end() || vehicle == it->first)
        there += fmt::format("{}of {} from {:.1f} to {:.1f} s", there.empty() ? "" : ", ", vehicle,
                             span.first_s, span.last_s);
    if (!wish_.vehicle.empty() && it == spans_.end())
      return fmt::format("there are no pictures of {}: there are {}", wish_.vehicle, there);
    const std::string asked = std::isinf(wish_.to_s)
                                  ? fmt::format("after {:g} s", wish_.from_s)
                                  : fmt::format("from {:g} to {:g} s", wish_.from_s, wish_.to_s);
    return fmt::format("there is no picture {}: there are {}", asked, there);
  }

  mcap::Reader reader_;
  const ClipWish wish_;
  std::string vehicle_;
  std::optional<double> begin_s_;
  double first_s_ = 0.0;                           // of the clip
  std::map<std::uint16_t, std::string> vehicles_;  // by channel
  std::map<std::string, Span> spans_;
  CdrBytes bytes_;
  sensor_msgs::msg::CompressedImage image_;
  RgbImage picture_;
  Film film_;
};

}  // namespace

Clip make_clip(const std::filesystem::path& recording, const ClipWish& wish) {
  return Cutter(recording, wish).cut();
}

}  // namespace foretrack::station
