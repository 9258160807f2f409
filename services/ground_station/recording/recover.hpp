// SPDX-License-Identifier: Apache-2.0
// Recordings that were not finished.
#pragma once

#include <filesystem>

namespace foretrack::station {

/// Gives files that were not finished (a kill, a full disk) their end, so that readers can seek.
/// Returns how many. Samples beyond the last whole chunk are gone.
int recover_recordings(const std::filesystem::path& folder);

}  // namespace foretrack::station
