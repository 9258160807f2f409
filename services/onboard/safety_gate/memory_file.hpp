// SPDX-License-Identifier: Apache-2.0
// The gate's memory on disk: what an operator ordered survives a kill and a power cut.
#pragma once

#include <filesystem>
#include <optional>

#include "core/safety/memory.hpp"

namespace foretrack {

/// None: there is no such file, or it is damaged or of another version.
std::optional<GateMemory> read_memory(const std::filesystem::path& file);

/// Replaces the file as a whole and waits until the disk has it; makes its folder if it is missing.
/// False, with the old file left as it was: the disk did not take it.
bool write_memory(const std::filesystem::path& file, const GateMemory& memory);

}  // namespace foretrack
