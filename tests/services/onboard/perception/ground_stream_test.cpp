// SPDX-License-Identifier: Apache-2.0
// Images on DDS come out as the ground's pictures.
#include "services/onboard/perception/ground_stream.hpp"

#include <gtest/gtest.h>

#include "core/perception/shrink_image.hpp"
#include "services/convert/camera_info.hpp"
#include "services/convert/compressed_image.hpp"
#include "services/convert/image.hpp"
#include "services/onboard/perception/perception_service.hpp"
#include "tests/services/onboard/neighbours.hpp"
#include "tests/support/h264_decoder.hpp"

namespace foretrack::testing {
namespace {

sensor_msgs::msg::CameraInfo calibration() {
  sensor_msgs::msg::CameraInfo info;
  to_idl(CameraModel::from_fov(640, 480, rad(90), rad(75)), 1.0, info);
  info.d({-0.1, 0.01, 0.0, 0.0, 0.0});
  return info;
}

TEST(ScaleCameraInfoTest, APointIsSeenAtTheSamePartOfTheImage) {
  const auto full = calibration();
  sensor_msgs::msg::CameraInfo small;
  scale_camera_info(full, 160, 120, small);
  EXPECT_EQ(small.width(), 160u);
  EXPECT_EQ(small.height(), 120u);
  EXPECT_EQ(small.d(), full.d());
  const auto a = from_idl(full), b = from_idl(small);
  ASSERT_TRUE(a && b);
  const Vec3 point(0.4, -0.3, 2.0);
  EXPECT_NEAR((*a->camera.project(point) - 4.0 * *b->camera.project(point)).norm(), 0.0, 1e-9);
}

TEST(ShareBandwidthTest, WhatIsReadAloneHasItAllAndBothHaveNoMoreThanItTogether) {
  const StreamParams params{.bandwidth_kbit_s = 1000.0};
  EXPECT_EQ(share_bandwidth(params, true, false).image.bandwidth_kbit_s, 1000.0);
  EXPECT_EQ(share_bandwidth(params, false, true).video.bandwidth_kbit_s, 1000.0);
  const auto both = share_bandwidth(params, true, true);
  EXPECT_DOUBLE_EQ(both.image.bandwidth_kbit_s + both.video.bandwidth_kbit_s, 1000.0);
  EXPECT_GT(both.image.bandwidth_kbit_s, both.video.bandwidth_kbit_s);
  EXPECT_TRUE(both.image.enabled && both.video.enabled);
  EXPECT_FALSE(share_bandwidth(params, true, false).video.enabled);
  EXPECT_FALSE(share_bandwidth({.enabled = false}, true, true).image.enabled);
}

class GroundStreamTest : public ::testing::Test {
 protected:
  // At 50 Hz, with no network needed.
  void feed() {
    const double stamp_s = neighbours_.now_s();
    to_idl(camera_, stamp_s, info_.sample());
    info_.write();
    to_idl(image_, stamp_s, color_.sample(), "eye");
    color_.write();
  }
  bool has_picture() {
    if (const auto* message = ground_info_.take_newest()) ground_camera_ = *message;
    const auto* message = ground_.take_newest();
    if (message) picture_ = *message;
    return message != nullptr;
  }

  CameraModel camera_ = CameraModel::from_fov(640, 480, rad(90), rad(75));
  RgbImage image_{640, 480, std::vector<std::uint8_t>(3 * 640 * 480, 90)};
  Neighbours neighbours_;
  Writer<topics::ColorImage> color_{neighbours_.node()};
  Writer<topics::ColorCameraInfo> info_{neighbours_.node()};
  Reader<topics::GroundImage> ground_{neighbours_.node()};
  Reader<topics::GroundCameraInfo> ground_info_{neighbours_.node()};
  sensor_msgs::msg::CompressedImage picture_;
  sensor_msgs::msg::CameraInfo ground_camera_;
};

TEST_F(GroundStreamTest, PicturesKeepTheirImagesStampAndFrameAndComeAtTheRateThatIsSet) {
  Running service([](const ServiceOptions& options, Stop& stop) {
    run_perception(options, {}, {}, {}, {.width_px = 320, .rate_hz = 10.0}, stop);
  });
  int pictures = 0;
  double first_s = 0.0, last_s = 0.0;
  ASSERT_TRUE(neighbours_.until(
      [&] {
        if (!has_picture()) return false;
        const double stamp_s = seconds(picture_.header().stamp());
        EXPECT_GT(stamp_s, last_s);
        last_s = stamp_s;
        if (++pictures == 1) first_s = stamp_s;
        return pictures == 21;
      },
      [&] { feed(); }));
  EXPECT_GT(last_s - first_s, 1.8);  // no faster; a busy machine may be slower
  EXPECT_EQ(picture_.header().frame_id(), "eye");
  EXPECT_EQ(picture_.format(), "jpeg");
  ASSERT_TRUE(eventually([&] {
    has_picture();
    return ground_camera_.header().stamp() == picture_.header().stamp();
  }));
  const auto camera = from_idl(ground_camera_);
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->camera.width_px, 320);
  EXPECT_TRUE(rgb_from_idl(picture_, camera->camera));
}

#if __has_include(<wels/codec_api.h>)
TEST_F(GroundStreamTest, TheVideoDecodesToTheImageWithItsStampAndFrame) {
  Running service([](const ServiceOptions& options, Stop& stop) {
    run_perception(options, {}, {}, {}, {.width_px = 320, .rate_hz = 30.0}, stop);
  });
  for (int row = 0; row < 480; ++row)
    for (int column = 0; column < 640; ++column)
      image_.pixel(column, row)[0] = static_cast<std::uint8_t>(column / 3);
  RgbImage small;
  shrink(image_, 320, small);
  Reader<topics::GroundVideo> video(neighbours_.node());
  H264Decoder viewer;
  int pictures = 0;
  double last_s = 0.0;
  ASSERT_TRUE(neighbours_.until(
      [&] {
        video.take_each([&](const foxglove_msgs::msg::CompressedVideo& message) {
          EXPECT_GT(seconds(message.timestamp()), last_s);
          last_s = seconds(message.timestamp());
          EXPECT_EQ(message.frame_id(), "eye");
          EXPECT_EQ(message.format(), "h264");
          const auto seen = viewer.decode(message.data());
          ASSERT_TRUE(seen) << pictures;
          EXPECT_GT(psnr_db(small, *seen), 35.0);
          ++pictures;
        });
        return pictures >= 20;
      },
      [&] { feed(); }));
  EXPECT_LT(neighbours_.now_s() - last_s, 5.0);
}
#endif

TEST_F(GroundStreamTest, NothingIsSentWhereItIsSwitchedOff) {
  Running service([](const ServiceOptions& options, Stop& stop) {
    run_perception(options, {}, {}, {}, {.enabled = false}, stop);
  });
  const double end_s = neighbours_.now_s() + 1.5;
  neighbours_.until([&] { return neighbours_.now_s() > end_s; }, [&] { feed(); });
  EXPECT_EQ(ground_.writers(), 0);
}

}  // namespace
}  // namespace foretrack::testing
