// SPDX-License-Identifier: Apache-2.0
// Terms that the features of several intentions are made of.
#pragma once

#include <cmath>

#include "core/prediction/intentions/intention_row.hpp"

namespace foretrack::intentions {

inline double positive(double x) {
  return std::max(x, 0.0);
}
inline double square(double x) {
  return x * x;
}

/// Time until an obstacle ahead is reached, with the target's own size taken off.
inline double time_to_obstacle_s(const MotionCues& motion, const Surroundings& s) {
  constexpr double kBody_m = 0.3;
  return positive(s.obstacle_distance_m - kBody_m) / std::max(motion.speed_m_s, 0.3);
}

/// The free width on a side furthest ahead, as far as the way ahead is free.
inline double last_width_m(const std::array<double, Surroundings::kSideCount>& width_m) {
  double last = width_m[0];
  for (const double w : width_m)
    if (w > 0.0) last = w;
  return last;
}

}  // namespace foretrack::intentions
