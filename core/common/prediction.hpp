// SPDX-License-Identifier: Apache-2.0
// Intentions, their assessment, and the paths that would follow.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/common/geometry.hpp"

namespace foretrack {

inline constexpr int kMaxIntentions = 16;  // that a table, or a message, may have

/// A place in the table of intentions (I of the paper, §III.C). The table of those that are
/// shipped, which also names their places, is core/prediction/intentions/intention_table.hpp:
/// nobody else needs to know which there are. Place 0 is what is expected while nothing else shows.
enum class Intention : std::uint8_t;
inline constexpr Intention kUnknownIntention{255};  // of a table that is not ours
/// Its place in arrays over the intentions.
constexpr int index_of(Intention i) {
  return static_cast<int>(i);
}

/// One row of the assessment (paper eq. 5–10; the probability is ours).
struct IntentionBelief {
  double potential = 0.0;    // R_i
  double observation = 0.0;  // O_i
  double score = 0.0;        // Π_i in [0, 1], not a distribution
  double probability = 0.0;  // calibrated; the rows sum to 1
};

/// Two sectors on the sides of the velocity (paper §III.B).
struct ReachableRegion {
  Vec3 center_enu_m = Vec3::Zero();
  double radius_m = 0.0;
  double heading_rad = 0.0;           // of the velocity
  double left_half_angle_rad = 0.0;   // θ_l in [0, π/4]
  double right_half_angle_rad = 0.0;  // θ_r
  double left_bisector_rad() const { return heading_rad + left_half_angle_rad; }
  double right_bisector_rad() const { return heading_rad - right_half_angle_rad; }
};

/// What planning makes room for (paper §V.A): to the left or to the right of the person, or before
/// them. In [0, 1]: the greatest score of the intentions that ask for it.
struct MarginScores {
  double left = 0.0;      // Π_tl
  double right = 0.0;     // Π_tr
  double distance = 0.0;  // Π_dec
};

/// What the target is likely to do: a belief for each intention.
struct IntentionAssessment {
  double stamp_s = 0.0;
  std::array<IntentionBelief, kMaxIntentions> beliefs{};  // the first `count`
  int count = 0;
  int unknown = 0;  // others that a message named: kept out, their probability is nobody else's
  MarginScores margins;
  ReachableRegion region;            // R(t)
  ReachableRegion region_ahead;      // R(t + t0)
  double obstacle_distance_m = 0.0;  // d_obs along the velocity; > range when nothing is there
  double body_turn_rad = 0.0;        // r_bv

  const IntentionBelief& operator[](Intention i) const { return beliefs[index_of(i)]; }
  IntentionBelief& operator[](Intention i) { return beliefs[index_of(i)]; }
  Intention most_likely() const {
    int best = 0;
    for (int i = 1; i < count; ++i)
      if (beliefs[i].probability > beliefs[best].probability) best = i;
    return static_cast<Intention>(best);
  }
};

/// (z_k, t_k) with its uncertainty.
struct PredictedState {
  double time_s = 0.0;  // after the prediction's stamp
  Vec3 position_enu_m = Vec3::Zero();
  Vec3 velocity_enu_m_s = Vec3::Zero();
  Mat2 covariance_m2 = Mat2::Zero();  // horizontal
};

/// A place on a predicted path, and the velocity there. World ENU.
struct PathPoint {
  Vec3 position_enu_m = Vec3::Zero();
  Vec3 velocity_enu_m_s = Vec3::Zero();
};

/// Where the target goes if it has one intention.
struct PredictedPath {
  Intention intention{};
  double probability = 0.0;
  std::vector<PredictedState> states;  // k = 1 … N_p, at time Δ, 2Δ, …, T_p

  /// Where the path has the person at a time after the prediction's stamp. Between states: linear.
  /// Before the first and after the last: along its velocity. Precondition: there are states.
  /// Cost: logarithmic in the states.
  PathPoint at(double time_s) const;
};

/// Whether the paths may be relied on.
enum class PredictionStatus : std::uint8_t { kOk, kNoTarget, kTargetBlocked, kSearchExhausted };

/// One path per intention that is possible here, most probable first; probabilities sum to 1.
struct Prediction {
  double stamp_s = 0.0;  // of the target state it starts from
  PredictionStatus status = PredictionStatus::kNoTarget;
  std::vector<PredictedPath> paths;
  int expansions = 0;
};

}  // namespace foretrack
