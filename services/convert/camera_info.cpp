// SPDX-License-Identifier: Apache-2.0
#include "services/convert/camera_info.hpp"

#include <stdexcept>

namespace foretrack {
namespace {

constexpr std::uint32_t kMaxSide_px = 16384;

}  // namespace

void to_idl(const CameraModel& in, double stamp_s, sensor_msgs::msg::CameraInfo& out,
            std::string_view frame) {
  set_header(out.header(), stamp_s, frame);
  out.width(in.width_px);
  out.height(in.height_px);
  out.distortion_model("plumb_bob");
  out.d().assign(5, 0.0);
  out.k({in.fx_px, 0, in.cx_px, 0, in.fy_px, in.cy_px, 0, 0, 1});
  out.r({1, 0, 0, 0, 1, 0, 0, 0, 1});
  out.p({in.fx_px, 0, in.cx_px, 0, 0, in.fy_px, in.cy_px, 0, 0, 0, 1, 0});
}

Converted<CameraWithLens> from_idl(const sensor_msgs::msg::CameraInfo& in) {
  Checks checks;
  checks.stamp("header.stamp", in.header().stamp());
  checks.in_range("width", in.width(), 1, kMaxSide_px);
  checks.in_range("height", in.height(), 1, kMaxSide_px);
  if (!checks.ok()) return checks.result(CameraWithLens());
  const int width_px = static_cast<int>(in.width()), height_px = static_cast<int>(in.height());
  if (const auto faults = faults_of_matrix(width_px, height_px, in.k()); !faults.empty())
    return Fault{"k", "k: " + faults.front()};
  try {
    const CameraWithLens camera{camera_of_matrix(width_px, height_px, in.k()),
                                lens_of(in.distortion_model(), in.d())};
    if (const auto fault = fault_of(camera); !fault.empty()) return Fault{"k", "k: " + fault};
    return camera;
  } catch (const std::invalid_argument& error) {
    return Fault{"d", error.what()};
  }
}

}  // namespace foretrack
