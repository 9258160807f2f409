// SPDX-License-Identifier: Apache-2.0
// Which framings may be ordered.
#pragma once

#include "core/common/framing.hpp"

namespace foretrack {

/// The ranges in which an operator may move the vehicle about the person.
struct FramingLimits {
  double distance_min_m = 1.5;
  double distance_max_m = 10.0;
  double height_min_m = -0.5;
  double height_max_m = 5.0;
  double circling_max_rad_s = 0.5;  // either way
};

/// What is wanted is finite and within the limits, a bearing within ±π; what is free is.
bool is_safe(const Framing& framing, const FramingLimits& limits);

}  // namespace foretrack
