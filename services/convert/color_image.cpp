// SPDX-License-Identifier: Apache-2.0
#include "services/convert/color_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "services/convert/geometry.hpp"

namespace foretrack {
namespace {

constexpr double kMostStep = 1e6;

using Pixels = const std::uint8_t*;
using CopyRow = void (*)(Pixels from, std::uint32_t width, std::uint8_t* to);

/// Where red, green and blue stand in a pixel.
template <int kBytes, int kRed, int kGreen, int kBlue>
void copy_row(Pixels from, std::uint32_t width, std::uint8_t* to) {
  for (std::uint32_t column = 0; column < width; ++column, from += kBytes, to += 3) {
    to[0] = from[kRed];
    to[1] = from[kGreen];
    to[2] = from[kBlue];
  }
}

void copy_plain(Pixels from, std::uint32_t width, std::uint8_t* to) {
  std::copy_n(from, 3 * static_cast<std::size_t>(width), to);
}

// BT.601 with video's range (luma 16 to 235), as cameras write it.
void put_yuv(int y, int u, int v, std::uint8_t* rgb) {
  const int c = 298 * (y - 16) + 128, d = u - 128, e = v - 128;
  const auto byte = [](int value) {
    return static_cast<std::uint8_t>(std::clamp(value >> 8, 0, 255));
  };
  rgb[0] = byte(c + 409 * e);
  rgb[1] = byte(c - 100 * d - 208 * e);
  rgb[2] = byte(c + 516 * d);
}

/// Two pixels in four bytes: where the first luma and u stand; the others two further.
template <int kLuma, int kU>
void copy_yuv_row(Pixels from, std::uint32_t width, std::uint8_t* to) {
  for (std::uint32_t column = 0; column + 1 < width; column += 2, from += 4, to += 6) {
    put_yuv(from[kLuma], from[kU], from[kU + 2], to);
    put_yuv(from[kLuma + 2], from[kU], from[kU + 2], to + 3);
  }
}

struct Encoding {
  std::string_view name;
  std::uint32_t bytes;  // a pixel
  CopyRow copy;
  bool in_pairs = false;  // the width is even
  bool in_words = false;  // of two bytes
};
constexpr std::array<Encoding, 10> kEncodings = {{{"rgb8", 3, copy_plain},
                                                  {"bgr8", 3, copy_row<3, 2, 1, 0>},
                                                  {"rgba8", 4, copy_row<4, 0, 1, 2>},
                                                  {"bgra8", 4, copy_row<4, 2, 1, 0>},
                                                  {"mono8", 1, copy_row<1, 0, 0, 0>},
                                                  {"mono16", 2, copy_row<2, 1, 1, 1>, false, true},
                                                  {"yuv422", 2, copy_yuv_row<1, 0>, true},
                                                  {"uyvy", 2, copy_yuv_row<1, 0>, true},
                                                  {"yuv422_yuy2", 2, copy_yuv_row<0, 1>, true},
                                                  {"yuyv", 2, copy_yuv_row<0, 1>, true}}};

}  // namespace

Converted<RgbImage> rgb_from_idl(const sensor_msgs::msg::Image& in, const CameraModel& camera,
                                 std::vector<std::uint8_t> buffer) {
  Checks checks;
  checks.stamp("header.stamp", in.header().stamp());
  const auto encoding = std::find_if(kEncodings.begin(), kEncodings.end(),
                                     [&](const Encoding& e) { return e.name == in.encoding(); });
  if (encoding == kEncodings.end()) {
    checks.fail("encoding", fmt::format("'{:.32}'", in.encoding()),
                "rgb8, bgr8, rgba8, bgra8, mono8, mono16, yuv422 or yuv422_yuy2");
    return checks.result(RgbImage());
  }
  if (encoding->in_words && in.is_bigendian())
    checks.fail("is_bigendian", "true", "false: the driver must write little-endian pixels");
  checks.in_range("width", in.width(), camera.width_px, camera.width_px);
  checks.in_range("height", in.height(), camera.height_px, camera.height_px);
  if (encoding->in_pairs && in.width() % 2 != 0)
    checks.fail("width", std::to_string(in.width()), "even, as two pixels share their colour");
  checks.in_range("step", in.step(), 1.0 * in.width() * encoding->bytes, kMostStep);
  if (!checks.ok()) return checks.result(RgbImage());
  const std::size_t bytes = static_cast<std::size_t>(in.step()) * in.height();
  checks.count("data", in.data().size(), bytes, bytes);
  if (!checks.ok()) return checks.result(RgbImage());
  RgbImage out{camera.width_px, camera.height_px, std::move(buffer)};
  out.rgb.resize(3 * static_cast<std::size_t>(in.width()) * in.height());
  for (std::uint32_t row = 0; row < in.height(); ++row)
    encoding->copy(in.data().data() + static_cast<std::size_t>(row) * in.step(), in.width(),
                   out.pixel(0, static_cast<int>(row)));
  return checks.result(std::move(out));
}

}  // namespace foretrack
