// SPDX-License-Identifier: Apache-2.0
// What usual drivers call their topics, so that nobody needs to remap one by one.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "services/common/names.hpp"

namespace foretrack {

struct Preset {
  std::string_view name;     // "realsense"
  std::string_view summary;  // whose defaults
  struct Remap {
    std::string_view name;   // ours
    std::string_view topic;  // the driver's
  };
  std::vector<Remap> remaps;
};

/// All of them: the drivers' defaults as far as we know them; docs/compatibility.md says what was
/// tried.
std::span<const Preset> presets();

/// "realsense, oak, …".
std::string preset_names();

/// Adds its remaps. Throws std::invalid_argument that names those that exist.
void add_preset(Names& names, std::string_view preset);

/// The presets all of whose topics are among those of the bus ("rt/camera/…").
std::vector<std::string_view> presets_that_fit(std::span<const std::string> wire_names);

}  // namespace foretrack
