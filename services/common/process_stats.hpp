// SPDX-License-Identifier: Apache-2.0
// What this process uses.
#pragma once

#include <cstdint>

namespace foretrack {

/// CPU use between two samples.
class CpuMeter {
 public:
  CpuMeter();
  /// Percent of one core since the last call, or since the start.
  double percent();

 private:
  double cpu_s_;
  double wall_s_;
};

/// Resident memory; 0 if /proc cannot be read.
std::uint64_t resident_bytes();

}  // namespace foretrack
