// SPDX-License-Identifier: Apache-2.0
// Why a plan is refused.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace foretrack {

/// Why a plan is refused.
enum class PlanFault : std::uint8_t {
  kNone,
  kTooLarge,      // more pieces or nodes than are flown, or longer
  kNotFinite,     // or times that are none
  kOldStart,      // it began long ago
  kFutureStart,   // or its stamp or start is far ahead
  kOutOfOrder,    // its id or start is before that of the last one
  kBroken,        // its pieces do not join
  kEndsInMotion,  // it has no stop
  kTooFast,
  kTooHard,       // acceleration
  kTurnsTooFast,  // yaw
  kDoesNotJoin,   // what is flown, or where the vehicle is
  kNoMap,
  kObstacle,
  kBody,
  kBounds,  // fence or altitudes
};
inline constexpr int kPlanFaultCount = 16;
/// For logs and displays.
std::string_view to_string(PlanFault fault);

/// How many plans were refused, by reason.
using PlanFaultCounts = std::array<std::uint32_t, kPlanFaultCount>;

}  // namespace foretrack
