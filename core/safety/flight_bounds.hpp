// SPDX-License-Identifier: Apache-2.0
// Where the vehicle may fly: a fence on the ground and a band of altitudes.
#pragma once

#include <array>
#include <limits>

namespace foretrack {

/// World ENU, metres. As an operator sets it, on top of what the parameters bound.
struct FlightBounds {
  static constexpr int kMaxCorners = 32;
  /// A corner of the fence.
  struct Corner {
    double x_m = 0.0, y_m = 0.0;
    bool operator==(const Corner&) const = default;
  };

  int corner_count = 0;  // 0: no fence
  std::array<Corner, kMaxCorners> corners_enu_m{};
  double altitude_min_m = -std::numeric_limits<double>::infinity();
  double altitude_max_m = std::numeric_limits<double>::infinity();

  bool operator==(const FlightBounds&) const = default;
};

/// No fence or one of three corners or more, finite, whose edges do not cross; a band that is not
/// empty. Cost: the square of the corners, for an order.
bool are_valid(const FlightBounds& bounds);

}  // namespace foretrack
