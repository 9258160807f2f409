// SPDX-License-Identifier: Apache-2.0
// What a parameter file says of the vehicle, where the command line does not say it.
#pragma once

#include "services/common/options.hpp"
#include "services/common/presets.hpp"
#include "services/files/config/load_vehicle.hpp"

namespace foretrack {

/// Throws std::invalid_argument as the options do.
inline void take_vehicle_section(const VehicleSection& section, Names& names) {
  Names of_file;
  for (const auto& preset : section.presets) add_preset(of_file, preset);
  for (const auto& remap : section.remaps) add_remap(of_file, remap);
  names.remaps.insert(of_file.remaps.begin(), of_file.remaps.end());  // those that are there stay
  if (names.px4_release.empty()) names.px4_release = section.px4;
  if (names.px4_namespace.empty()) names.px4_namespace = section.px4_namespace;
  if (names.body_frame == Names().body_frame && !section.base_frame.empty())
    names.body_frame = section.base_frame;
  names.odometry_is_map |= section.odometry_is_map.value_or(false);
  validate_or_throw(names);
}

inline void take_vehicle_section(const VehicleSection& section, ServiceOptions& options) {
  take_vehicle_section(section, options.names);
  if (options.color_mount.empty()) options.color_mount = section.color_mount;
  if (options.depth_mount.empty()) options.depth_mount = section.depth_mount;
}

}  // namespace foretrack
