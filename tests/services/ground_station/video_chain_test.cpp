// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/hub/video_chain.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "services/ground_station/hub/hub.hpp"

namespace foretrack::station {
namespace {

constexpr std::uint8_t kKeyUnit = 0x65, kOtherUnit = 0x41;

Channel video_channel(std::uint32_t id) {
  Channel c;
  c.id = id;
  c.topic = "/uav1/camera/ground/video";
  c.schema_name = "foxglove_msgs/msg/CompressedVideo";
  return c;
}

// As Fast CDR writes it, little endian.
Bytes video_cdr(std::uint8_t unit, const std::string& frame_id = "camera", std::uint8_t mark = 0) {
  Bytes cdr{0, 1, 0, 0};
  const auto put_u32 = [&](std::uint32_t value) {
    while (cdr.size() % 4 != 0) cdr.push_back(0);
    for (int shift = 0; shift < 32; shift += 8)
      cdr.push_back(static_cast<std::uint8_t>(value >> shift));
  };
  put_u32(10), put_u32(20);  // the stamp
  put_u32(static_cast<std::uint32_t>(frame_id.size() + 1));
  cdr.insert(cdr.end(), frame_id.begin(), frame_id.end());
  cdr.push_back(0);
  const Bytes data{0, 0, 0, 1, 0x09, 0x10, 0, 0, 0, 1, unit, mark, 7, 7};
  put_u32(static_cast<std::uint32_t>(data.size()));
  cdr.insert(cdr.end(), data.begin(), data.end());
  return cdr;
}

Sample picture(std::uint8_t unit, std::uint8_t mark) {
  return {1, mark, std::make_shared<const Bytes>(video_cdr(unit, "camera", mark))};
}

struct Viewer {
  explicit Viewer(Hub& hub) : client(hub.join("test", {[] {}, [](const std::string&) {}}, 0.0)) {}
  void subscribe(double now_s) {
    client->on_text(R"({"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 1}]})", now_s);
  }
  /// Log times of the pictures that come.
  std::vector<int> take(double now_s) {
    std::vector<int> marks;
    while (const auto frame = client->next(now_s))
      if (frame->data) marks.push_back(frame->header[5]);
    return marks;
  }
  std::shared_ptr<Client> client;
};

TEST(VideoChain, KnowsKeyPicturesWhateverTheLengthOfTheFrameName) {
  for (const auto* frame : {"", "a", "ab", "abc", "camera_optical_frame"}) {
    EXPECT_EQ(chain_of(video_channel(1), video_cdr(kKeyUnit, frame)), Chain::kKey) << frame;
    EXPECT_EQ(chain_of(video_channel(1), video_cdr(kOtherUnit, frame)), Chain::kNeedsPrevious);
  }
  auto image = video_channel(1);
  image.schema_name = "sensor_msgs/msg/CompressedImage";
  EXPECT_EQ(chain_of(image, video_cdr(kOtherUnit)), Chain::kAlone);
}

TEST(VideoChain, MalformedSamplesHangTogetherWithNothing) {
  const auto whole = video_cdr(kOtherUnit);
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_EQ(chain_of(video_channel(1), std::span(whole).first(size)), Chain::kAlone) << size;
  auto endless = whole;
  endless[12] = 0xff, endless[15] = 0xff;  // the frame's name is longer than all
  EXPECT_EQ(chain_of(video_channel(1), endless), Chain::kAlone);
}

TEST(VideoChain, WhoSubscribesLateGetsTheVideoFromItsLastKeyOn) {
  Hub hub("station", "1", {});
  hub.open(video_channel(1));
  for (const auto& [unit, mark] : {std::pair{kOtherUnit, 1},
                                   {kKeyUnit, 2},
                                   {kOtherUnit, 3},
                                   {kKeyUnit, 4},
                                   {kOtherUnit, 5},
                                   {kOtherUnit, 6}})
    hub.deliver({picture(unit, static_cast<std::uint8_t>(mark))}, 0.1);
  Viewer viewer(hub);
  viewer.subscribe(0.2);
  EXPECT_EQ(viewer.take(0.2), (std::vector{4, 5, 6}));
}

TEST(VideoChain, OfAnImageForTheGroundALateSubscriberGetsTheLastUnlessItIsOld) {
  Hub hub("station", "1", {});
  auto image = video_channel(1);
  image.schema_name = "sensor_msgs/msg/CompressedImage";
  image.topic = "/uav1/camera/ground/image/compressed";
  hub.open(image);
  for (std::uint8_t mark = 1; mark < 4; ++mark) hub.deliver({picture(kOtherUnit, mark)}, 0.1);
  Viewer viewer(hub), later(hub);
  viewer.subscribe(0.9);
  EXPECT_EQ(viewer.take(0.9), std::vector{3});
  later.subscribe(1.2);
  EXPECT_TRUE(later.take(1.2).empty());
}

TEST(VideoChain, OfAVideoThatLostAPictureNothingGoesOutUntilItsNextKey) {
  Hub hub("station", "1", {});
  hub.open(video_channel(1));
  Viewer viewer(hub);
  viewer.take(0.0);
  viewer.subscribe(0.0);
  hub.deliver({picture(kKeyUnit, 1)}, 0.0);
  hub.deliver({picture(kOtherUnit, 2)}, 0.1);
  EXPECT_EQ(viewer.take(0.1), (std::vector{1, 2}));
  viewer.take(0.11);                           // they were sent at once
  hub.deliver({picture(kOtherUnit, 3)}, 0.2);  // waits for too long
  hub.deliver({picture(kOtherUnit, 4)}, 0.3);
  hub.deliver({picture(kOtherUnit, 5)}, 1.0);
  EXPECT_TRUE(viewer.take(1.0).empty());
  hub.deliver({picture(kOtherUnit, 6)}, 1.1);
  hub.deliver({picture(kKeyUnit, 7)}, 1.2);
  hub.deliver({picture(kOtherUnit, 8)}, 1.3);
  EXPECT_EQ(viewer.take(1.3), (std::vector{7, 8}));
}

}  // namespace
}  // namespace foretrack::station
