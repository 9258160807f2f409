// SPDX-License-Identifier: Apache-2.0
#include "services/convert/color_image.hpp"

#include <algorithm>
#include <stdexcept>

#include "services/convert/geometry.hpp"
#include "services/convert/image.hpp"

namespace foretrack {
namespace {

constexpr double kMostStep = 1e6;

void copy_row(const std::uint8_t* from, std::uint32_t width, bool mono, bool bgr,
              std::uint8_t* to) {
  if (!mono && !bgr) {
    std::copy_n(from, 3 * static_cast<std::size_t>(width), to);
    return;
  }
  for (std::uint32_t column = 0; column < width; ++column, to += 3) {
    const std::uint8_t* pixel = mono ? from + column : from + 3 * static_cast<std::size_t>(column);
    to[0] = mono ? pixel[0] : pixel[2];
    to[1] = mono ? pixel[0] : pixel[1];
    to[2] = pixel[0];
  }
}

}  // namespace

Converted<RgbImage> rgb_from_idl(const sensor_msgs::msg::Image& in, const CameraModel& camera,
                                 std::vector<std::uint8_t> buffer) {
  Checks checks;
  const bool mono = in.encoding() == "mono8", bgr = in.encoding() == "bgr8";
  checks.stamp("header.stamp", in.header().stamp());
  if (!mono && !bgr && in.encoding() != "rgb8")
    checks.fail("encoding", in.encoding().substr(0, 32), "rgb8, bgr8 or mono8");
  checks.in_range("width", in.width(), camera.width_px, camera.width_px);
  checks.in_range("height", in.height(), camera.height_px, camera.height_px);
  checks.in_range("step", in.step(), in.width() * (mono ? 1.0 : 3.0), kMostStep);
  if (!checks.ok()) return checks.result(RgbImage());
  const std::size_t bytes = static_cast<std::size_t>(in.step()) * in.height();
  checks.count("data", in.data().size(), bytes, bytes);
  if (!checks.ok()) return checks.result(RgbImage());
  RgbImage out{camera.width_px, camera.height_px, std::move(buffer)};
  out.rgb.resize(3 * static_cast<std::size_t>(in.width()) * in.height());
  for (std::uint32_t row = 0; row < in.height(); ++row)
    copy_row(in.data().data() + static_cast<std::size_t>(row) * in.step(), in.width(), mono, bgr,
             out.pixel(0, static_cast<int>(row)));
  return checks.result(std::move(out));
}

Converted<CameraWithLens> lens_from_idl(const sensor_msgs::msg::CameraInfo& in,
                                        const Pose& T_body_camera) {
  sensor_msgs::msg::CameraInfo pinhole = in;
  pinhole.d().clear();
  const auto camera = from_idl(pinhole, T_body_camera);
  if (!camera) return camera.fault();
  try {
    return CameraWithLens{*camera, lens_of(in.distortion_model(), in.d())};
  } catch (const std::invalid_argument& error) {
    return Fault{"distortion", error.what()};
  }
}

}  // namespace foretrack
