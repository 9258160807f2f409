// SPDX-License-Identifier: Apache-2.0
// From where an operator wants to see the person who is followed.
#pragma once

#include <cmath>
#include <limits>

namespace foretrack {

/// As ordered. NaN: nothing is wanted, and planning's parameters say.
struct Framing {
  static constexpr double kFree = std::numeric_limits<double>::quiet_NaN();

  double distance_m = kFree;  ///< of the vehicle from the person, horizontally
  double height_m = kFree;    ///< of the vehicle above the middle of their torso
  /// Of the vehicle from the person, counterclockwise from where they walk: 0 ahead, π/2 left.
  double bearing_rad = kFree;
  /// The same, counterclockwise from east: a fleet's seat. It comes before bearing_rad.
  double bearing_enu_rad = kFree;
  bool is_seat = false;  ///< of a fleet: taken on faster
  /// By which the bearing goes round, counterclockwise; 0: it does not.
  double circling_rad_s = 0.0;

  /// Nothing is wanted.
  bool is_free() const {
    return std::isnan(distance_m) && std::isnan(height_m) && std::isnan(bearing_rad) &&
           std::isnan(bearing_enu_rad) && circling_rad_s == 0.0;
  }
  /// NaN is the same as NaN.
  bool operator==(const Framing& other) const {
    const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
    return same(distance_m, other.distance_m) && same(height_m, other.height_m) &&
           same(bearing_rad, other.bearing_rad) && same(bearing_enu_rad, other.bearing_enu_rad) &&
           same(circling_rad_s, other.circling_rad_s);
  }
};

}  // namespace foretrack
