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

/// Keeps the prediction, also one whose search was cut short: it is used as far as it goes. Without
/// any path, or for a target inside an obstacle, a constant-velocity path of the target.
void update_belief(TargetBelief& belief, const TargetState& target, const Prediction* prediction,
                   const HorizonParams& params);

/// Where the target is on a believed path, a time after the belief's stamp. After its end a path
/// goes on with its last velocity for a short time and then stands still.
Vec3 position_on(const PredictedPath& path, double time_s);

/// z_k at t_k = Δ … T_p after a trajectory's start, of one intention.
struct ExpectedPath {
  const PredictedPath* believed = nullptr;  // of the TargetBelief, which must outlive this
  double start_s = 0.0;                     // of the trajectory, on the believed path's clock
  double probability = 0.0;
  std::vector<Vec3> positions_enu_m;
  std::vector<Vec3> velocities_enu_m_s;

  /// Where the target is expected at t after the trajectory's start: on the believed path, which it
  /// goes on for a short time after its end; then it stands.
  Vec3 position(double t_s) const;
};

/// The paths to plan for; probabilities sum to 1.
struct ExpectedTarget {
  std::array<ExpectedPath, kMaxIntentions> paths;  // the first `count`, most probable first
  int count = 0;

  /// The likeliest path whose z_k is within near_m of path i's, or i itself.
  int owner(int i, std::size_t k, double near_m) const;
};

/// Moves the believed paths to start_s by interpolation. Paths below the least probability are left
/// out, or all but the first without hedging.
void align(const TargetBelief& belief, double start_s, const HorizonParams& params,
           ExpectedTarget& expected);

}  // namespace foretrack
