// SPDX-License-Identifier: Apache-2.0
#include "services/convert/compressed_image.hpp"

#include <gmock/gmock.h>
#include <jpeglib.h>
#include <png.h>

#include <cstdlib>

namespace foretrack {
namespace {

using testing::HasSubstr;

CameraModel camera() {
  return CameraModel::from_fov(40, 30, rad(90), rad(75));
}

RgbImage image() {
  RgbImage out{40, 30, {}};
  for (int row = 0; row < 30; ++row)
    for (int column = 0; column < 40; ++column)
      for (const int value : {6 * column, 8 * row, 100})
        out.rgb.push_back(static_cast<std::uint8_t>(value));
  return out;
}

std::vector<std::uint8_t> as_png(const RgbImage& picture) {
  png_image encoder{};
  encoder.version = PNG_IMAGE_VERSION;
  encoder.width = static_cast<png_uint_32>(picture.width_px);
  encoder.height = static_cast<png_uint_32>(picture.height_px);
  encoder.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  png_image_write_to_memory(&encoder, nullptr, &size, 0, picture.rgb.data(), 0, nullptr);
  std::vector<std::uint8_t> bytes(size);
  png_image_write_to_memory(&encoder, bytes.data(), &size, 0, picture.rgb.data(), 0, nullptr);
  bytes.resize(size);
  return bytes;
}

std::vector<std::uint8_t> as_jpeg(const RgbImage& picture) {
  jpeg_compress_struct encoder{};
  jpeg_error_mgr errors{};
  encoder.err = jpeg_std_error(&errors);
  jpeg_create_compress(&encoder);
  unsigned char* memory = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&encoder, &memory, &size);
  encoder.image_width = static_cast<JDIMENSION>(picture.width_px);
  encoder.image_height = static_cast<JDIMENSION>(picture.height_px);
  encoder.input_components = 3;
  encoder.in_color_space = JCS_RGB;
  jpeg_set_defaults(&encoder);
  jpeg_set_quality(&encoder, 95, TRUE);
  jpeg_start_compress(&encoder, TRUE);
  for (int row = 0; row < picture.height_px; ++row) {
    JSAMPROW pixels = const_cast<JSAMPROW>(picture.pixel(0, row));
    jpeg_write_scanlines(&encoder, &pixels, 1);
  }
  jpeg_finish_compress(&encoder);
  std::vector<std::uint8_t> bytes(memory, memory + size);
  jpeg_destroy_compress(&encoder);
  std::free(memory);
  return bytes;
}

sensor_msgs::msg::CompressedImage message(std::vector<std::uint8_t> data) {
  sensor_msgs::msg::CompressedImage out;
  out.header().stamp().sec(3);
  out.format("rgb8; jpeg compressed bgr8");
  out.data(std::move(data));
  return out;
}

TEST(CompressedImageMessage, APngIsReadAsItWas) {
  const auto out = rgb_from_idl(message(as_png(image())), camera());
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->rgb, image().rgb);
}

TEST(CompressedImageMessage, AJpegIsReadNearlyAsItWas) {
  const auto out = rgb_from_idl(message(as_jpeg(image())), camera());
  ASSERT_TRUE(out) << out.fault().text;
  for (std::size_t i = 0; i < out->rgb.size(); ++i)
    ASSERT_NEAR(out->rgb[i], image().rgb[i], 24) << i;
}

TEST(CompressedImageMessage, NamesWhatItRefuses) {
  const auto fault = [](std::vector<std::uint8_t> data) {
    const auto out = rgb_from_idl(message(std::move(data)), camera());
    return out ? std::string("none") : out.fault().text;
  };
  EXPECT_THAT(fault({}), HasSubstr("a JPEG or PNG picture"));
  EXPECT_THAT(fault({'R', 'I', 'F', 'F', 0, 0}), HasSubstr("'rgb8; jpeg compressed bgr8'"));
  RgbImage small = image();
  small.height_px = 20;
  EXPECT_THAT(fault(as_png(small)), HasSubstr("40 × 20 px, expected 40 × 30 px"));
  EXPECT_THAT(fault(as_jpeg(small)), HasSubstr("40 × 20 px, expected 40 × 30 px"));
}

// A PNG without its end mark has all its pixels.
TEST(CompressedImageMessage, NoBytesCrashAndHalfAPictureIsNone) {
  constexpr std::size_t kEndMark = 24;
  for (const auto& whole : {as_png(image()), as_jpeg(image())}) {
    for (std::size_t at = 0; at < whole.size(); at += 3) {
      auto bytes = whole;
      bytes[at] ^= 0x55;
      rgb_from_idl(message(bytes), camera());
      bytes.resize(at);
      const auto out = rgb_from_idl(message(bytes), camera());
      if (at + kEndMark < whole.size()) {
        EXPECT_FALSE(out) << at;
      }
    }
  }
}

}  // namespace
}  // namespace foretrack
