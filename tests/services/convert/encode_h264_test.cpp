// SPDX-License-Identifier: Apache-2.0
// What is encoded decodes to the picture that was put in, within the bandwidth.
#include "services/convert/encode_h264.hpp"

#include <gtest/gtest.h>

#include "core/perception/stream_pace.hpp"
#include "tests/support/h264_decoder.hpp"
#include "tests/support/street.hpp"

#if __has_include(<wels/codec_api.h>)

namespace foretrack::testing {
namespace {

using Bytes = std::vector<std::uint8_t>;

// The types of its units: 7 and 8 are parameter sets, 5 a key picture, 1 one that leans on others.
std::vector<int> units(const Bytes& picture) {
  std::vector<int> out;
  for (std::size_t i = 0; i + 4 < picture.size(); ++i)
    if (picture[i] == 0 && picture[i + 1] == 0 && picture[i + 2] == 0 && picture[i + 3] == 1)
      out.push_back(picture[i + 4] & 31);
  return out;
}
const std::vector<int> kKey = {7, 8, 5}, kOther = {1};

TEST(EncodeH264Test, EachPictureDecodesAtOnceToWhatWasPutIn) {
  H264Encoder encoder;
  H264Decoder viewer;
  Bytes picture;
  for (int i = 0; i < 30; ++i) {
    const RgbImage image = street(3.0 * i);
    encoder.encode(image, {100.0 + i / 15.0, 2000.0, 15.0, 1}, picture);
    const auto seen = viewer.decode(picture);
    ASSERT_TRUE(seen) << i;
    ASSERT_EQ(seen->width_px, 320);
    ASSERT_EQ(seen->height_px, 240);
    EXPECT_GT(psnr_db(image, *seen), 32.0) << i;
    EXPECT_LT(psnr_db(street(3.0 * i + 30.0), *seen), 25.0) << i;  // another one is told apart
  }
}

TEST(EncodeH264Test, AKeyPictureWithItsParameterSetsComesEachSecondAndForWhoeverIsNew) {
  H264Encoder encoder;
  Bytes picture;
  for (int i = 0; i < 40; ++i) {
    encoder.encode(street(2.0 * i), {i / 10.0, 2000.0, 15.0, i < 25 ? 1 : 2}, picture);
    const bool key = i == 0 || i == 10 || i == 20 || i == 25 || i == 35;
    EXPECT_EQ(units(picture), key ? kKey : kOther) << i;
  }
}

TEST(EncodeH264Test, WhoComesLaterDecodesFromTheNextKeyPictureOn) {
  H264Encoder encoder;
  H264Decoder late;
  Bytes picture;
  int seen = 0;
  for (int i = 0; i < 20; ++i) {
    encoder.encode(street(2.0 * i), {i / 10.0, 2000.0, 15.0, 1}, picture);
    if (i >= 5) seen += late.decode(picture) ? 1 : 0;
  }
  EXPECT_EQ(seen, 10);
}

TEST(EncodeH264Test, ItIsConstrainedBaselineSoThatEveryBrowserDecodesIt) {
  H264Encoder encoder;
  Bytes picture;
  encoder.encode(street(0.0), {0.0, 2000.0, 15.0, 1}, picture);
  ASSERT_GT(picture.size(), 7u);
  EXPECT_EQ(picture[5], 66);           // baseline
  EXPECT_EQ(picture[6] & 0x40, 0x40);  // constrained
}

TEST(EncodeH264Test, AnotherSizeOrAnEarlierStampBeginsAnew) {
  H264Encoder encoder;
  Bytes picture;
  encoder.encode(street(0.0), {5.0, 2000.0, 15.0, 1}, picture);
  encoder.encode(street(1.0, 160, 120), {5.1, 2000.0, 15.0, 1}, picture);
  EXPECT_EQ(units(picture), kKey);
  const auto seen = H264Decoder().decode(picture);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->width_px, 160);
  encoder.encode(street(2.0, 160, 120), {1.0, 2000.0, 15.0, 1}, picture);
  EXPECT_EQ(units(picture), kKey);
}

TEST(EncodeH264Test, OfAnOddSizeTheLastRowAndColumnAreLeftOut) {
  H264Encoder encoder;
  Bytes picture;
  const RgbImage image = street(0.0, 161, 121);
  encoder.encode(image, {0.0, 4000.0, 15.0, 1}, picture);
  const auto seen = H264Decoder().decode(picture);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->width_px, 160);
  EXPECT_EQ(seen->height_px, 120);
  EXPECT_GT(psnr_db(street(0.0, 160, 120), *seen), 25.0);
}

TEST(EncodeH264Test, WhatIsTooSmallForItGivesNothing) {
  H264Encoder encoder;
  Bytes picture(10);
  encoder.encode(street(0.0, 64, 8), {0.0, 2000.0, 15.0, 1}, picture);
  EXPECT_TRUE(picture.empty());
}

// What moves all over, with noise that does not compress, thinned as the ground stream does.
TEST(EncodeH264Test, TenSecondsOfPicturesThatMoveStayWithinTheBandwidth) {
  const StreamParams params{.bandwidth_kbit_s = 500.0};
  H264Encoder encoder;
  StreamPace pace;
  Bytes picture;
  double bytes = 0.0;
  int pictures = 0;
  unsigned noise = 1;
  for (int i = 0; i < 300; ++i) {
    const double stamp_s = i / 30.0;
    if (!is_due(pace, stamp_s, params)) continue;
    RgbImage image = street(7.0 * i);
    for (auto& value : image.rgb) value ^= (noise = noise * 1664525u + 1013904223u) >> 28;
    encoder.encode(image, {stamp_s, params.bandwidth_kbit_s, params.rate_hz, 1}, picture);
    sent(pace, stamp_s, static_cast<double>(picture.size()), params);
    bytes += static_cast<double>(picture.size());
    ++pictures;
  }
  EXPECT_LT(bytes * 8.0 / 10.0, 1.03 * 500e3);
  EXPECT_GE(pictures, 100);  // ten a second at least
}

}  // namespace
}  // namespace foretrack::testing

#endif
