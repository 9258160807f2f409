// SPDX-License-Identifier: Apache-2.0
// Time as PX4's messages have it.
#pragma once

#include <cmath>
#include <cstdint>

namespace foretrack {

inline std::uint64_t microseconds(double stamp_s) {
  return static_cast<std::uint64_t>(std::llround(stamp_s * 1e6));
}

}  // namespace foretrack
