// SPDX-License-Identifier: Apache-2.0
// The files that the middleware's shared-memory transport keeps in /dev/shm.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace foretrack {

struct SharedMemoryFile {
  std::string name;  // in /dev/shm
  std::uint64_t bytes = 0;
  bool in_use = false;  // some living process holds it
};

/// All files of Fast DDS, by name.
std::vector<SharedMemoryFile> shared_memory_files();
/// Names of the Fast DDS files that a process has mapped or open; empty if it is gone.
std::set<std::string> mapped_shared_memory(pid_t pid);
/// Removes those of the files, and what belongs to them, that no living process holds.
void remove_shared_memory(const std::set<std::string>& names);

}  // namespace foretrack
