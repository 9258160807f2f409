// SPDX-License-Identifier: Apache-2.0
// Clips of recordings: what a reader that is not ours finds in them, and why there is none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/videoio.hpp>

#include "sensor_msgs/msg/CompressedImage.h"
#include "services/common/raw.hpp"
#include "services/common/topics.hpp"
#include "services/convert/encode_jpeg.hpp"
#include "services/convert/geometry.hpp"
#include "services/ground_station/clip/make_clip.hpp"
#include "services/ground_station/mcap/writer.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/h264_decoder.hpp"
#include "tests/support/street.hpp"

#if __has_include(<vpx/vpx_encoder.h>)

namespace foretrack::station {
namespace {

using foretrack::testing::street;
using ::testing::HasSubstr;

constexpr double kBegin_s = 1'700'000'000.0, kDelay_s = 0.04;  // of the link

struct Recorded {
  const char* vehicle;
  double stamp_s;  // from kBegin_s
  RgbImage image;
};

class ClipTest : public ::testing::Test {
 protected:
  std::filesystem::path record(const std::vector<Recorded>& pictures) {
    const auto path = folder_.path / "a.mcap";
    std::ofstream out(path, std::ios::binary);
    mcap::Writer writer(
        [&](std::span<const std::uint8_t> piece) {
          out.write(reinterpret_cast<const char*>(piece.data()),
                    static_cast<std::streamsize>(piece.size()));
          return true;
        },
        "test");
    const auto other = add_channel(writer, "rt/uav1/odometry");
    writer.write(other, static_cast<std::uint64_t>(kBegin_s * 1e9), {});
    std::map<std::string, std::uint16_t> channels;
    for (const auto& [vehicle, stamp_s, image] : pictures) {
      auto& id = channels[vehicle];
      const std::string wire = "rt/" + std::string(vehicle) + "/camera/ground/image/compressed";
      if (id == 0) id = add_channel(writer, wire);
      sensor_msgs::msg::CompressedImage message;
      set_header(message.header(), kBegin_s + stamp_s, "camera");
      encode_jpeg(image, 90, message.data());
      const auto time_ns = static_cast<std::uint64_t>((kBegin_s + stamp_s + kDelay_s) * 1e9);
      writer.write(id, time_ns, to_cdr(type_ops<sensor_msgs::msg::CompressedImage>(), &message));
    }
    writer.finish();
    return path;
  }
  static std::uint16_t add_channel(mcap::Writer& writer, const std::string& wire) {
    return writer.add_channel({wire.substr(2), "cdr", "", "", "", {{"dds_topic", wire}}});
  }
  cv::VideoCapture open(const Clip& clip) const {
    const auto path = folder_.path / "clip.webm";
    std::ofstream(path, std::ios::binary) << clip.webm;
    return cv::VideoCapture(path.string());
  }
  static RgbImage rgb_of(const cv::Mat& bgr) {
    RgbImage out{bgr.cols, bgr.rows, std::vector<std::uint8_t>(3ul * bgr.cols * bgr.rows)};
    for (int row = 0; row < bgr.rows; ++row)
      for (int column = 0; column < bgr.cols; ++column)
        for (int c = 0; c < 3; ++c)
          out.pixel(column, row)[c] = bgr.at<cv::Vec3b>(row, column)[2 - c];
    return out;
  }
  std::string why_not(const std::vector<Recorded>& pictures, const ClipWish& wish) {
    try {
      make_clip(record(pictures), wish);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }

  foretrack::testing::Folder folder_;
};

// Not at one rate: ten a second, then a gap, then three a second.
std::vector<Recorded> walk(const char* vehicle = "uav1") {
  std::vector<Recorded> pictures;
  double stamp_s = 1.0;
  for (int i = 0; i < 60; ++i) {
    pictures.push_back({vehicle, stamp_s, street(3.0 * i)});
    stamp_s += i == 29 ? 5.0 : i < 29 ? 0.1 : 0.333;
  }
  return pictures;
}

TEST_F(ClipTest, AnotherReaderFindsEachPictureAtItsOwnTime) {
  const auto pictures = walk();
  const Clip clip = make_clip(record(pictures), {});
  EXPECT_EQ(clip.vehicle, "uav1");
  EXPECT_EQ(clip.pictures, 60);
  EXPECT_EQ(clip.left_out, 0);
  auto video = open(clip);
  ASSERT_TRUE(video.isOpened());
  cv::Mat bgr;
  for (const auto& [vehicle, stamp_s, image] : pictures) {
    ASSERT_TRUE(video.read(bgr)) << stamp_s;
    EXPECT_NEAR(video.get(cv::CAP_PROP_POS_MSEC), 1e3 * (stamp_s - 1.0), 1.5);
    EXPECT_GT(foretrack::testing::psnr_db(image, rgb_of(bgr)), 28.0) << stamp_s;
  }
  EXPECT_FALSE(video.read(bgr));
}

TEST_F(ClipTest, ASpanIsByTheTimeOfTheRecording) {
  const Clip clip = make_clip(record(walk()), {.vehicle = {}, .from_s = 1.5, .to_s = 2.5});
  EXPECT_EQ(clip.pictures, 10);
  auto video = open(clip);
  cv::Mat bgr;
  ASSERT_TRUE(video.read(bgr));
  EXPECT_GT(foretrack::testing::psnr_db(street(3.0 * 5), rgb_of(bgr)), 28.0) << "that of 1.5 s";
}

// As RFC 9559 has it: cues give the time of a cluster and its place in the segment.
TEST_F(ClipTest, ItIsSoughtByCuesThatPointToClustersOfTheirTimes) {
  const std::string file = make_clip(record(walk()), {}).webm;
  const auto number_at = [&](std::size_t at) {
    std::uint64_t value = 0;
    for (std::size_t i = at; i < at + 8; ++i)
      value = value << 8 | static_cast<std::uint8_t>(file[i]);
    return value;
  };
  const std::string eight("\x01\0\0\0\0\0\0\x08", 8);  // of a size of eight bytes
  const auto segment = file.find("\x18\x53\x80\x67") + 12, cues = file.find("\x1C\x53\xBB\x6B");
  const auto first_cluster = file.find("\x1F\x43\xB6\x75");
  ASSERT_LT(cues, first_cluster);
  EXPECT_EQ(number_at(segment - 8) & 0xFFFFFFFFFFFFFF, file.size() - segment);
  std::vector<std::uint64_t> times_ms;
  for (auto at = cues; (at = file.find("\xB3" + eight, at)) < first_cluster; ++at) {
    times_ms.push_back(number_at(at + 9));
    const auto cluster = segment + number_at(file.find("\xF1" + eight, at) + 9);
    EXPECT_EQ(file.substr(cluster, 4), "\x1F\x43\xB6\x75");
    EXPECT_EQ(number_at(cluster + 12 + 9), times_ms.back());
  }
  ASSERT_GE(times_ms.size(), 6u);  // of 17.6 s, in 5 of which there is nothing
  for (std::size_t i = 1; i < times_ms.size(); ++i) {
    EXPECT_GE(times_ms[i], times_ms[i - 1] + 2000);
    EXPECT_LE(times_ms[i], times_ms[i - 1] + 6000);
  }
}

TEST_F(ClipTest, OfSeveralVehiclesOneIsNamed) {
  auto both = walk("uav1");
  for (auto& picture : walk("uav2")) both.push_back(std::move(picture));
  EXPECT_THAT(why_not(both, {}), HasSubstr("uav1 and uav2 have pictures: say which"));
  EXPECT_EQ(make_clip(record(both), {.vehicle = "uav2"}).pictures, 60);
  EXPECT_THAT(why_not(both, {.vehicle = "uav7"}),
              HasSubstr("no pictures of uav7: there are of uav1 from 1.0 to"));
}

TEST_F(ClipTest, WhereThereIsNoneTheReasonSaysWhatThereIs) {
  EXPECT_THAT(why_not({}, {}), HasSubstr("there are no pictures in it"));
  EXPECT_EQ(why_not(walk(), {.vehicle = {}, .from_s = 100.0, .to_s = 110.0}),
            "there is no picture from 100 to 110 s: there are of uav1 from 1.0 to 18.6 s");
  ClipWish late;
  late.from_s = 100.0;
  EXPECT_THAT(why_not(walk(), late), HasSubstr("no picture after 100 s: there are of uav1"));
  EXPECT_THAT(why_not({{"uav1", 0.0, street(0, 64, 48)}, {"uav1", 700.0, street(0, 64, 48)}}, {}),
              HasSubstr("at most 600 s"));
  std::ofstream(folder_.path / "no.mcap") << "no recording";
  EXPECT_THROW(make_clip(folder_.path / "no.mcap", {}), std::runtime_error);
}

TEST_F(ClipTest, WhatDoesNotFitIsLeftOutAndCounted) {
  auto pictures = walk();
  pictures[10].image = street(0.0, 160, 120);   // of another size
  pictures[20].stamp_s = pictures[19].stamp_s;  // a double
  pictures[30].image = {};                      // broken
  const Clip clip = make_clip(record(pictures), {});
  EXPECT_EQ(clip.pictures, 57);
  EXPECT_EQ(clip.left_out, 3);
}

}  // namespace
}  // namespace foretrack::station

#endif
