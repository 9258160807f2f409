// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/perception/picture_encoder.hpp"

#include <gtest/gtest.h>

#include "services/common/time_now.hpp"
#include "tests/services/common/bus.hpp"
#include "tests/support/h264_decoder.hpp"

namespace foretrack::testing {
namespace {

RgbImage grey(int width, int height) {
  return {width, height, std::vector<std::uint8_t>(3ul * width * height, 128)};
}

TEST(PictureEncoderTest, APictureComesBackScaledWithItsLabel) {
  PictureEncoder encoder;
  EncodedPicture out;
  EXPECT_FALSE(encoder.take(out));
  encoder.give(grey(320, 240), {12.5, "camera", 80, 60});
  ASSERT_TRUE(eventually([&] { return encoder.take(out); }));
  EXPECT_EQ(out.label.stamp_s, 12.5);
  EXPECT_EQ(out.label.frame_id, "camera");
  EXPECT_EQ(out.width_px, 80);
  EXPECT_EQ(out.height_px, 60);
  ASSERT_GT(out.jpeg.size(), 100u);
  EXPECT_EQ(out.jpeg[0], 0xFF);
  EXPECT_EQ(out.jpeg[1], 0xD8);
  EXPECT_FALSE(encoder.take(out));
}

TEST(PictureEncoderTest, WhoGivesMoreThanCanBeEncodedDoesNotWaitAndTheNewestComesBack) {
  PictureEncoder encoder;
  const RgbImage large = grey(6000, 4000), small = grey(32, 24);
  EncodedPicture out;
  encoder.give(large, {0.0, "camera", 6000, 90});
  const double begin_s = steady_s();
  for (int i = 1; i <= 100; ++i) encoder.give(small, {1.0 * i, "camera", 32, 60});
  const double given_s = steady_s();
  ASSERT_TRUE(eventually([&] { return encoder.take(out); }));
  EXPECT_LT(given_s - begin_s, 0.5 * (steady_s() - begin_s));  // the large one takes its time
  ASSERT_TRUE(eventually([&] {
    encoder.take(out);
    return out.label.stamp_s == 100.0;
  }));
}

#if __has_include(<wels/codec_api.h>)
TEST(PictureEncoderTest, EachPictureOfAVideoDecodesAlsoWhereMoreAreGivenThanAreEncoded) {
  PictureEncoder encoder;
  H264Decoder viewer;
  EncodedPicture out;
  RgbImage image = grey(320, 240);
  int taken = 0;
  for (int i = 1; taken < 20; ++i) {
    ASSERT_LT(i, 1000000);
    image.rgb[i % image.rgb.size()] = 255;
    encoder.give(image, {0.01 * i, "camera", 320, {}, VideoWish{0.01 * i, 1000.0, 15.0, 1}});
    if (i % 50 != 0 || !encoder.take(out)) continue;
    ++taken;
    EXPECT_TRUE(viewer.decode(out.video)) << taken;
  }
}
#endif

TEST(PictureEncoderTest, BothKindsOfOnePictureComeAtOnceAndNoneThatWasNotAskedFor) {
  PictureEncoder encoder;
  EncodedPicture out;
  const VideoWish wish{2.0, 1000.0, 15.0, 1};
  encoder.give(grey(320, 240), {2.0, "camera", 80, 60, wish});
  ASSERT_TRUE(eventually([&] { return encoder.take(out); }));
  EXPECT_FALSE(out.jpeg.empty());
  EXPECT_EQ(out.video.empty(), !has_video_encoder());
  encoder.give(grey(320, 240), {3.0, "camera", 80, 60});
  ASSERT_TRUE(eventually([&] { return encoder.take(out); }));
  EXPECT_FALSE(out.jpeg.empty());
  EXPECT_TRUE(out.video.empty());
}

}  // namespace
}  // namespace foretrack::testing
