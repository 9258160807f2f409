// SPDX-License-Identifier: Apache-2.0
#include "core/safety/framing_limits.hpp"

#include "core/common/geometry.hpp"

namespace foretrack {
namespace {

constexpr double kRounding_rad = 1e-6;

bool is_free_or_within(double value, double min, double max) {
  return std::isnan(value) || (value >= min && value <= max);
}

}  // namespace

bool is_safe(const Framing& framing, const FramingLimits& limits) {
  constexpr double kRound_rad = kPi + kRounding_rad;
  return is_free_or_within(framing.distance_m, limits.distance_min_m, limits.distance_max_m) &&
         is_free_or_within(framing.height_m, limits.height_min_m, limits.height_max_m) &&
         is_free_or_within(framing.bearing_rad, -kRound_rad, kRound_rad) &&
         std::abs(framing.circling_rad_s) <= limits.circling_max_rad_s;
}

}  // namespace foretrack
