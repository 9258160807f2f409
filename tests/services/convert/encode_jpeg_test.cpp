// SPDX-License-Identifier: Apache-2.0
#include "services/convert/encode_jpeg.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "services/convert/compressed_image.hpp"

namespace foretrack {
namespace {

RgbImage slope() {
  RgbImage image{64, 48, {}};
  for (int row = 0; row < 48; ++row)
    for (int column = 0; column < 64; ++column)
      for (const int value : {4 * column, 5 * row, 100})
        image.rgb.push_back(static_cast<std::uint8_t>(value));
  return image;
}

RgbImage decoded(const std::vector<std::uint8_t>& jpeg) {
  sensor_msgs::msg::CompressedImage message;
  message.format("jpeg");
  message.data().assign(jpeg.begin(), jpeg.end());
  auto image = rgb_from_idl(message, CameraModel::from_fov(64, 48, rad(90), rad(75)));
  EXPECT_TRUE(image);
  return image ? *image : RgbImage{};
}

TEST(EncodeJpegTest, WhatIsEncodedIsWhatADecoderSees) {
  std::vector<std::uint8_t> jpeg;
  encode_jpeg(slope(), 95, jpeg);
  const RgbImage image = slope(), back = decoded(jpeg);
  ASSERT_EQ(back.rgb.size(), image.rgb.size());
  for (std::size_t i = 0; i < image.rgb.size(); ++i) ASSERT_NEAR(back.rgb[i], image.rgb[i], 8) << i;
}

TEST(EncodeJpegTest, ALowerQualityIsSmaller) {
  std::vector<std::uint8_t> good, bad;
  encode_jpeg(slope(), 90, good);
  encode_jpeg(slope(), 20, bad);
  EXPECT_LT(bad.size(), good.size());
}

TEST(EncodeJpegTest, WhatIsNoPictureIsNoJpeg) {
  std::vector<std::uint8_t> jpeg{1, 2, 3};
  encode_jpeg(RgbImage{}, 50, jpeg);
  EXPECT_TRUE(jpeg.empty());
}

}  // namespace
}  // namespace foretrack
