// SPDX-License-Identifier: Apache-2.0
// Recordings of a folder within a limit of disk and of days.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace foretrack::station {

struct KeepLimits {
  std::uint64_t bytes = 0;
  double days = 0.0;
};

/// Removes the folder's recordings (*.mcap) that were last written to longer ago, and of the rest
/// the oldest until it is within the limit. `now_written`, a file's name, stays. Returns how many
/// went.
int keep_within(const std::filesystem::path& folder, const KeepLimits& limits,
                const std::string& now_written = "");

}  // namespace foretrack::station
