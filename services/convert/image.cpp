// SPDX-License-Identifier: Apache-2.0
#include "services/convert/image.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "services/convert/geometry.hpp"

namespace foretrack {
namespace {

static_assert(std::endian::native == std::endian::little);
constexpr char kFloatMetres[] = "32FC1";
constexpr char kMillimetres[] = "16UC1";
constexpr char kMillimetresToo[] = "mono16";

// Rows may be padded.
template <class Pixel, class Convert>
void read_rows(const sensor_msgs::msg::Image& in, std::vector<float>& out, Convert convert) {
  out.resize(static_cast<std::size_t>(in.width()) * in.height());
  float* to = out.data();
  for (std::uint32_t row = 0; row < in.height(); ++row) {
    const std::uint8_t* from = in.data().data() + static_cast<std::size_t>(row) * in.step();
    for (std::uint32_t column = 0; column < in.width(); ++column, from += sizeof(Pixel)) {
      Pixel pixel;
      std::memcpy(&pixel, from, sizeof pixel);
      *to++ = convert(pixel);
    }
  }
}

std::string quoted(const std::string& encoding) {
  return fmt::format("'{:.32}'", encoding);
}

// Negative and infinitely near are no depths; 0 is "no return". +inf means free to the range.
float valid_depth(float depth_m) {
  return depth_m >= 0.0f ? depth_m : 0.0f;
}

}  // namespace

void to_idl(const RgbImage& in, double stamp_s, sensor_msgs::msg::Image& out,
            std::string_view frame) {
  set_header(out.header(), stamp_s, frame);
  out.width(static_cast<std::uint32_t>(in.width_px));
  out.height(static_cast<std::uint32_t>(in.height_px));
  out.encoding("rgb8");
  out.is_bigendian(0);
  out.step(3 * out.width());
  out.data() = in.rgb;
}

void to_idl(const DepthImage& in, sensor_msgs::msg::Image& out, std::string_view frame) {
  set_header(out.header(), in.stamp_s, frame);
  out.width(in.camera.width_px);
  out.height(in.camera.height_px);
  out.encoding(kFloatMetres);
  out.is_bigendian(0);
  out.step(out.width() * sizeof(float));
  out.data().resize(in.depth_m.size() * sizeof(float));
  std::memcpy(out.data().data(), in.depth_m.data(), out.data().size());
}

Converted<DepthImage> from_idl(const sensor_msgs::msg::Image& in, const CameraModel& camera,
                               std::vector<float> buffer) {
  Checks checks;
  const bool metres = in.encoding() == kFloatMetres;
  checks.stamp("header.stamp", in.header().stamp());
  if (!metres && in.encoding() != kMillimetres && in.encoding() != kMillimetresToo)
    checks.fail("encoding", quoted(in.encoding()), "32FC1 (metres), 16UC1 or mono16 (millimetres)");
  if (in.is_bigendian())
    checks.fail("is_bigendian", "true", "false: the driver must write little-endian pixels");
  checks.in_range("width", in.width(), camera.width_px, camera.width_px);
  checks.in_range("height", in.height(), camera.height_px, camera.height_px);
  const double least_step = in.width() * (metres ? 4.0 : 2.0);
  checks.in_range("step", in.step(), least_step, 1e6);
  if (!checks.ok()) return checks.result(DepthImage());
  const std::size_t bytes = static_cast<std::size_t>(in.step()) * in.height();
  checks.count("data", in.data().size(), bytes, bytes);
  if (!checks.ok()) return checks.result(DepthImage());
  if (metres)
    read_rows<float>(in, buffer, valid_depth);
  else
    read_rows<std::uint16_t>(in, buffer, [](std::uint16_t mm) { return 1e-3f * mm; });
  DepthImage out{seconds(in.header().stamp()), camera, std::move(buffer)};
  return checks.result(std::move(out));
}

}  // namespace foretrack
