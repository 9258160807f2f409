// SPDX-License-Identifier: Apache-2.0
#include "services/common/presets.hpp"

#include <algorithm>
#include <stdexcept>

namespace foretrack {
namespace {

constexpr std::string_view kColor = "camera/color/image";
constexpr std::string_view kColorInfo = "camera/color/camera_info";
constexpr std::string_view kCompressed = "camera/color/image/compressed";
constexpr std::string_view kDepth = "camera/depth/image";
constexpr std::string_view kDepthInfo = "camera/depth/camera_info";

const std::vector<Preset>& all() {
  static const std::vector<Preset> kPresets = {
      {"realsense",
       "realsense2_camera 4.54 and later: camera/camera/…",
       {{kColor, "camera/camera/color/image_raw"},
        {kColorInfo, "camera/camera/color/camera_info"},
        {kDepth, "camera/camera/depth/image_rect_raw"},
        {kDepthInfo, "camera/camera/depth/camera_info"}}},
      {"realsense_aligned",
       "the same with align_depth.enable: depth in the colour camera's frame",
       {{kColor, "camera/camera/color/image_raw"},
        {kColorInfo, "camera/camera/color/camera_info"},
        {kDepth, "camera/camera/aligned_depth_to_color/image_raw"},
        {kDepthInfo, "camera/camera/aligned_depth_to_color/camera_info"}}},
      {"oak",
       "depthai_ros_driver, pipeline RGBD",
       {{kColor, "oak/rgb/image_raw"},
        {kColorInfo, "oak/rgb/camera_info"},
        {kDepth, "oak/stereo/image_raw"},
        {kDepthInfo, "oak/stereo/camera_info"}}},
      {"zed",
       "zed_wrapper up to 4: zed/zed_node/…",
       {{kColor, "zed/zed_node/rgb/image_rect_color"},
        {kColorInfo, "zed/zed_node/rgb/camera_info"},
        {kDepth, "zed/zed_node/depth/depth_registered"},
        {kDepthInfo, "zed/zed_node/depth/camera_info"}}},
      {"orbbec",
       "orbbec_camera",
       {{kColor, "camera/color/image_raw"},
        {kColorInfo, "camera/color/camera_info"},
        {kDepth, "camera/depth/image_raw"},
        {kDepthInfo, "camera/depth/camera_info"}}},
      {"usb_cam",
       "usb_cam: colour alone, the map must come from elsewhere",
       {{kColor, "image_raw"}, {kCompressed, "image_raw/compressed"}, {kColorInfo, "camera_info"}}},
      {"mavros",
       "mavros' local position as the odometry",
       {{"odometry", "mavros/local_position/odom"}}}};
  return kPresets;
}

}  // namespace

std::span<const Preset> presets() {
  return all();
}

std::string preset_names() {
  std::string names;
  for (const Preset& preset : all())
    names += (names.empty() ? "" : ", ") + std::string(preset.name);
  return names;
}

void add_preset(Names& names, std::string_view name) {
  for (const Preset& preset : all()) {
    if (preset.name != name) continue;
    for (const auto& remap : preset.remaps) names.remaps[std::string(remap.name)] = remap.topic;
    return;
  }
  throw std::invalid_argument("--preset " + std::string(name) + ": there are " + preset_names());
}

std::vector<std::string_view> presets_that_fit(std::span<const std::string> wire_names) {
  std::vector<std::string_view> fitting;
  for (const Preset& preset : all()) {
    const bool fits = std::all_of(preset.remaps.begin(), preset.remaps.end(), [&](const auto& r) {
      if (r.name == kCompressed) return true;  // beside the plain ones
      const auto wire = "rt/" + std::string(r.topic);
      return std::find(wire_names.begin(), wire_names.end(), wire) != wire_names.end();
    });
    if (fits) fitting.push_back(preset.name);
  }
  return fitting;
}

}  // namespace foretrack
