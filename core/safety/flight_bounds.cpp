// SPDX-License-Identifier: Apache-2.0
#include "core/safety/flight_bounds.hpp"

#include <cmath>

namespace foretrack {
namespace {

using Corner = FlightBounds::Corner;

// Twice the area of the triangle; its sign says on which side of ab the point c is.
double side(const Corner& a, const Corner& b, const Corner& c) {
  return (b.x_m - a.x_m) * (c.y_m - a.y_m) - (b.y_m - a.y_m) * (c.x_m - a.x_m);
}

bool cross(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
  return side(a, b, c) * side(a, b, d) <= 0.0 && side(c, d, a) * side(c, d, b) <= 0.0;
}

bool edges_cross(const FlightBounds& bounds) {
  const int n = bounds.corner_count;
  const auto corner = [&](int i) -> const Corner& { return bounds.corners_enu_m[i % n]; };
  for (int i = 0; i < n; ++i)
    for (int k = i + 2; k < n; ++k) {
      const bool neighbours = i == 0 && k == n - 1;
      if (!neighbours && cross(corner(i), corner(i + 1), corner(k), corner(k + 1))) return true;
    }
  return false;
}

bool corners_are_finite(const FlightBounds& bounds) {
  for (int i = 0; i < bounds.corner_count; ++i)
    if (!std::isfinite(bounds.corners_enu_m[i].x_m + bounds.corners_enu_m[i].y_m)) return false;
  return true;
}

}  // namespace

bool are_valid(const FlightBounds& bounds) {
  const int n = bounds.corner_count;
  if (n != 0 && (n < 3 || n > FlightBounds::kMaxCorners)) return false;
  if (!(bounds.altitude_min_m < bounds.altitude_max_m)) return false;
  return corners_are_finite(bounds) && !edges_cross(bounds);
}

}  // namespace foretrack
