// SPDX-License-Identifier: Apache-2.0
// The last second or so of a target, thinned to 50 states a second.
#pragma once

#include <array>

#include "core/common/target.hpp"
#include "core/prediction/motion_models.hpp"

namespace foretrack {

/// Owned by the caller of predict().
struct MotionHistory {
  /// A state of the target and its stamp.
  struct Sample {
    double stamp_s = 0.0;
    PlanarState measured;        // as the tracker says
    double body_yaw_rad = 0.0;   // NaN: not known
    double body_turn_rad = 0.0;  // r_bv
  };
  static constexpr int kCapacity = 64;
  std::array<Sample, kCapacity> samples{};
  int newest = 0;
  int count = 0;

  /// i = 0: the newest.
  const Sample& back(int i) const { return samples[(newest - i + kCapacity) % kCapacity]; }
  /// The youngest sample that is at least this much older than stamp_s, or else the oldest.
  const Sample& before(double stamp_s, double age_s) const;
};

/// A stamp that goes back, a gap of more than a second, or a jump starts the history anew.
void remember(MotionHistory& history, const MotionHistory::Sample& sample);

}  // namespace foretrack
