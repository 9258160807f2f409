// SPDX-License-Identifier: Apache-2.0
// Where the files are that ship with the program: scenarios, parameters, QoS profiles.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace foretrack {

/// Folders that may hold shipped files, first to last: $FORETRACK_SHARE, <executable>/../share/
/// foretrack, the source tree that the program was built from. Only those that exist.
std::vector<std::filesystem::path> share_folders();

/// The first shipped file of that relative name ("deploy/scenarios/t_intersection.yaml",
/// "qos/profiles.xml"). Throws std::runtime_error that lists where it looked.
std::filesystem::path find_share(std::string_view relative_path);

}  // namespace foretrack
