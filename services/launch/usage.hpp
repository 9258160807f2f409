// SPDX-License-Identifier: Apache-2.0
// Processor time and memory of a process, as the kernel counts them.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>

namespace foretrack {

struct ProcessUsage {
  double cpu_s = 0.0;           // user and system, all threads, since its start
  std::uint64_t pss_bytes = 0;  // proportional share of what it has in memory
};

/// Empty if the process is gone.
std::optional<ProcessUsage> usage_of(pid_t pid);

}  // namespace foretrack
