// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/hub/light_picture.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sensor_msgs/msg/CompressedImage.h"
#include "services/common/raw.hpp"
#include "services/convert/compressed_image.hpp"
#include "services/convert/encode_jpeg.hpp"
#include "services/ground_station/hub/hub.hpp"

namespace foretrack::station {
namespace {

constexpr double kPeriod_s = 1.0 / 15.0;
const auto kOps = type_ops<sensor_msgs::msg::CompressedImage>();

Channel pictures() {
  Channel c;
  c.id = 1;
  c.topic = "/uav1/camera/ground/image/compressed";
  c.schema_name = "sensor_msgs/msg/CompressedImage";
  return c;
}

/// With detail, so that it is heavy.
std::shared_ptr<const Bytes> picture() {
  RgbImage image{640, 480, std::vector<std::uint8_t>(3ul * 640 * 480)};
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    image.rgb[i] = static_cast<std::uint8_t>((i / 24 * 37) % 200 + i % 3);
  sensor_msgs::msg::CompressedImage message;
  message.format("jpeg");
  message.header().stamp().sec(7);
  message.header().frame_id("camera");
  encode_jpeg(image, 60, message.data());
  return std::make_shared<const Bytes>(to_cdr(kOps, &message));
}

sensor_msgs::msg::CompressedImage message_of(const Bytes& cdr) {
  sensor_msgs::msg::CompressedImage message;
  EXPECT_TRUE(from_cdr(kOps, cdr, &message));
  return message;
}
int width_of(const Bytes& cdr) {
  const auto image = rgb_of_any_size(message_of(cdr));
  return image ? image->width_px : 0;
}

TEST(LightPicture, IsTheSamePictureWithAFractionOfTheBytes) {
  const auto full = picture();
  const auto light = lighten(*full);
  ASSERT_NE(light, nullptr);
  EXPECT_EQ(width_of(*light), 320);
  EXPECT_LT(light->size(), full->size() / 2);
  const auto message = message_of(*light);
  EXPECT_EQ(message.header().stamp().sec(), 7);
  EXPECT_EQ(message.header().frame_id(), "camera");
  EXPECT_EQ(message.format(), "jpeg");
}

TEST(LightPicture, WhatIsNoPictureStaysWhatItIs) {
  EXPECT_EQ(lighten(Bytes(5000, 3)), nullptr);
  auto channel = pictures();
  channel.topic = "/uav1/camera/color/image/compressed";
  EXPECT_FALSE(can_be_lighter(channel));
  channel = pictures();
  channel.schema_name = "foretrack_msgs/msg/Trajectory";
  EXPECT_FALSE(can_be_lighter(channel));
}

/// Counts what a client takes over a link of so many bytes a second, as it was and lighter.
struct Viewer {
  Viewer(Hub& hub, std::shared_ptr<const Bytes> as_it_was, double bytes_s)
      : client(hub.join("test", {[] {}, [](const std::string&) {}}, 0.0)),
        whole(std::move(as_it_was)),
        rate_bytes_s(bytes_s) {
    const nlohmann::json wanted = {{"op", "subscribe"},
                                   {"subscriptions", {{{"id", 0}, {"channelId", 1}}}}};
    client->on_text(wanted.dump(), 0.0);
  }
  void read_until(double now_s) {
    while (free_s < now_s) {
      const double begin_s = std::max(free_s, now_s - kPeriod_s);
      const auto frame = client->next(begin_s);
      if (!frame) return;
      free_s = begin_s + static_cast<double>(frame->bytes()) / rate_bytes_s;
      if (!frame->text) ++(frame->data == whole ? full : light);
    }
  }
  std::shared_ptr<Client> client;
  std::shared_ptr<const Bytes> whole;
  double rate_bytes_s, free_s = 0.0;
  int full = 0, light = 0;
};

TEST(LightPicture, GoesToTheSlowClientAloneAndOnlyWhileItsLinkIsSlow) {
  Hub hub("station", "1", {});
  hub.open(pictures());
  const auto data = picture();
  const double full_rate = static_cast<double>(data->size()) / kPeriod_s;
  Viewer slow(hub, data, 0.55 * full_rate), fast(hub, data, 100.0 * full_rate);
  int at = 0;
  const auto play = [&](double seconds) {
    slow.full = slow.light = fast.full = fast.light = 0;
    for (const int end = at + static_cast<int>(seconds / kPeriod_s); at < end; ++at) {
      const double now_s = at * kPeriod_s;
      hub.deliver({{1, 1, data}}, now_s);
      slow.read_until(now_s + kPeriod_s), fast.read_until(now_s + kPeriod_s);
    }
  };
  play(20.0);
  EXPECT_EQ(fast.light, 0);
  EXPECT_GT(fast.full, 290);
  EXPECT_GT(slow.light, 200) << "of 300, and " << slow.full << " as they were";
  slow.rate_bytes_s = 100.0 * full_rate;
  play(25.0);  // so long it takes at most to see that the link is better
  play(5.0);
  EXPECT_EQ(slow.light, 0);
  EXPECT_GT(slow.full, 70);
}

}  // namespace
}  // namespace foretrack::station
