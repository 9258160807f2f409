// SPDX-License-Identifier: Apache-2.0
#include "services/convert/compressed_image.hpp"

#include <fmt/format.h>
#include <jpeglib.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <span>

#include "services/convert/geometry.hpp"

namespace foretrack {
namespace {

using Bytes = std::span<const std::uint8_t>;

bool begins_with(Bytes data, std::initializer_list<std::uint8_t> head) {
  return data.size() > head.size() && std::equal(head.begin(), head.end(), data.begin());
}

std::string size_text(unsigned width, unsigned height) {
  return fmt::format("{} × {} px", width, height);
}

// libjpeg leaves by longjmp: no object with a destructor may live between setjmp and its calls.
struct JpegErrors : jpeg_error_mgr {
  std::jmp_buf leave;
};
void leave(j_common_ptr decoder) {
  std::longjmp(static_cast<JpegErrors*>(decoder->err)->leave, 1);
}
void say_nothing(j_common_ptr) {}

enum class Decoded { kWell, kBroken, kOtherSize };
struct Size {
  unsigned width = 0, height = 0;
};

Decoded decode_jpeg(Bytes data, Size expected, Size& found, std::uint8_t* rgb) {
  jpeg_decompress_struct decoder{};
  JpegErrors errors{};
  decoder.err = jpeg_std_error(&errors);
  errors.error_exit = leave;
  errors.output_message = say_nothing;
  if (setjmp(errors.leave) != 0) {
    jpeg_destroy_decompress(&decoder);
    return Decoded::kBroken;
  }
  jpeg_create_decompress(&decoder);
  jpeg_mem_src(&decoder, data.data(), static_cast<unsigned long>(data.size()));
  jpeg_read_header(&decoder, TRUE);
  found = {decoder.image_width, decoder.image_height};
  const bool fits = found.width == expected.width && found.height == expected.height;
  if (fits) {
    decoder.out_color_space = JCS_RGB;
    jpeg_start_decompress(&decoder);
    while (decoder.output_scanline < decoder.output_height) {
      JSAMPROW row = rgb + 3ul * expected.width * decoder.output_scanline;
      jpeg_read_scanlines(&decoder, &row, 1);
    }
    jpeg_finish_decompress(&decoder);
  }
  // Bytes that are missing are made up, with a warning.
  const bool whole = errors.num_warnings == 0;
  jpeg_destroy_decompress(&decoder);
  return !fits ? Decoded::kOtherSize : whole ? Decoded::kWell : Decoded::kBroken;
}

Decoded decode_png(Bytes data, Size expected, Size& found, std::uint8_t* rgb) {
  png_image decoder{};
  decoder.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&decoder, data.data(), data.size()) == 0)
    return Decoded::kBroken;
  found = {decoder.width, decoder.height};
  const bool fits = found.width == expected.width && found.height == expected.height;
  decoder.format = PNG_FORMAT_RGB;
  const bool read = fits && png_image_finish_read(&decoder, nullptr, rgb, 0, nullptr) != 0;
  png_image_free(&decoder);
  return !fits ? Decoded::kOtherSize : read ? Decoded::kWell : Decoded::kBroken;
}

constexpr unsigned kMostPx = 4096;

bool is_jpeg(Bytes data) {
  return begins_with(data, {0xFF, 0xD8, 0xFF});
}
bool is_png(Bytes data) {
  return begins_with(data, {0x89, 'P', 'N', 'G'});
}

}  // namespace

Converted<RgbImage> rgb_from_idl(const sensor_msgs::msg::CompressedImage& in,
                                 const CameraModel& camera, std::vector<std::uint8_t> buffer) {
  Checks checks;
  checks.stamp("header.stamp", in.header().stamp());
  const Bytes data(in.data());
  const bool jpeg = is_jpeg(data), png = is_png(data);
  if (!jpeg && !png)
    checks.fail("format", fmt::format("'{:.32}'", in.format()), "a JPEG or PNG picture");
  if (!checks.ok()) return checks.result(RgbImage());
  RgbImage out{camera.width_px, camera.height_px, std::move(buffer)};
  out.rgb.resize(3 * static_cast<std::size_t>(camera.width_px) * camera.height_px);
  const Size expected{static_cast<unsigned>(camera.width_px),
                      static_cast<unsigned>(camera.height_px)};
  Size found;
  const Decoded decoded = jpeg ? decode_jpeg(data, expected, found, out.rgb.data())
                               : decode_png(data, expected, found, out.rgb.data());
  if (decoded == Decoded::kOtherSize)
    checks.fail("data", size_text(found.width, found.height),
                size_text(expected.width, expected.height) + ", as the camera_info says");
  if (decoded == Decoded::kBroken)
    checks.fail("data", fmt::format("a broken picture of {} bytes", data.size()), "a whole one");
  return checks.result(std::move(out));
}

Converted<RgbImage> rgb_of_any_size(const sensor_msgs::msg::CompressedImage& in,
                                    std::vector<std::uint8_t> buffer) {
  const Bytes data(in.data());
  Size size;  // nothing is decoded, as none is expected to be so small
  if (is_jpeg(data)) decode_jpeg(data, {}, size, nullptr);
  if (is_png(data)) decode_png(data, {}, size, nullptr);
  if (std::max(size.width, size.height) > kMostPx) {
    Checks checks;
    checks.fail("data", size_text(size.width, size.height), "at most 4096 px a side");
    return checks.result(RgbImage());
  }
  CameraModel camera;
  camera.width_px = static_cast<int>(size.width);
  camera.height_px = static_cast<int>(size.height);
  return rgb_from_idl(in, camera, std::move(buffer));
}

}  // namespace foretrack
