// SPDX-License-Identifier: Apache-2.0
// The files that the middleware's shared-memory transport keeps in /dev/shm.
#pragma once

#include <sys/types.h>

#include <set>
#include <string>

namespace foretrack {

/// Names of the Fast DDS files that a process has mapped or open; empty if it is gone.
std::set<std::string> mapped_shared_memory(pid_t pid);
/// Removes those of the files, and what belongs to them, that no living process holds.
void remove_shared_memory(const std::set<std::string>& names);

}  // namespace foretrack
