// SPDX-License-Identifier: Apache-2.0
// The section "vehicle" of a parameter file: how this vehicle is wired.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace foretrack {

/// As the command line has them; what is missing is empty.
struct VehicleSection {
  std::vector<std::string> remaps;   // "odometry:=mavros/local_position/odom"
  std::vector<std::string> presets;  // "realsense"
  std::string px4, px4_namespace, base_frame;
  std::optional<bool> odometry_is_map;
  std::vector<double> color_mount, depth_mount;  // x, y, z (m), roll, pitch, yaw (rad)
};

/// remap, preset, px4, px4_namespace, base_frame, odometry_is_map, color_mount, depth_mount. Throws
/// std::invalid_argument that names every fault with its line. The words themselves are checked
/// where they are used.
VehicleSection load_vehicle(const std::string& file);

}  // namespace foretrack
