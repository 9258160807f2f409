// SPDX-License-Identifier: Apache-2.0
// Where the target is expected to be, on the clock of a new trajectory.
#pragma once

#include <array>
#include <vector>

#include "core/common/prediction.hpp"
#include "core/common/target.hpp"
#include "core/planning/plan_params.hpp"

namespace foretrack {

/// The last prediction, kept for the time after the target is lost. Owned by the caller and reused.
struct TargetBelief {
  double stamp_s = 0.0;
  std::array<PredictedPath, kMaxIntentions> paths;  // the first `count`, most probable first
  int count = 0;
};

/// Keeps the prediction; without a usable one, a constant-velocity path of the target.
void update_belief(TargetBelief& belief, const TargetState& target, const Prediction* prediction,
                   const HorizonParams& params);

/// z_k at t_k = Δ … T_p after a trajectory's start, of one intention.
struct ExpectedPath {
  double probability = 0.0;
  std::vector<Vec3> positions_enu_m;
  std::vector<Vec3> velocities_enu_m_s;

  /// Between the z_k; the first before t_1 and the last after T_p.
  Vec3 position(double t_s, double step_s) const;
};

/// The paths to plan for; probabilities sum to 1.
struct ExpectedTarget {
  std::array<ExpectedPath, kMaxIntentions> paths;  // the first `count`, most probable first
  int count = 0;

  /// The likeliest path whose z_k is within near_m of path i's, or i itself.
  int owner(int i, std::size_t k, double near_m) const;
};

/// Moves the believed paths to start_s by interpolation. After its end a path goes on with its last
/// velocity for a short time and then stands still. Paths below the least probability are left out,
/// or all but the first without hedging.
void align(const TargetBelief& belief, double start_s, const HorizonParams& params,
           ExpectedTarget& expected);

}  // namespace foretrack
