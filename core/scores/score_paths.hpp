// SPDX-License-Identifier: Apache-2.0
// How good predicted paths were, beside constant velocity and constant turn.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "core/common/target.hpp"
#include "core/scores/truth.hpp"

namespace foretrack {

/// The times after a prediction at which paths are judged.
inline constexpr std::array<double, 4> kPathHorizons_s = {0.5, 1.0, 2.0, 3.0};

/// Whose path is judged: the prediction's most probable one, the best of its paths, or one of the
/// two baselines, which go on from the estimate with its velocity or with its turn rate as well.
enum class PathKind : std::uint8_t { kMostProbable, kBest, kConstantVelocity, kConstantTurn };
inline constexpr std::array<std::string_view, 4> kPathKindNames = {
    "most probable", "best of K", "constant velocity", "constant turn"};

/// Which moments are judged: all of a walking target, those whose label is a turn, and those that
/// three seconds of straight walking follow.
enum class PathWindows : std::uint8_t { kAll, kTurning, kStraight };
inline constexpr std::array<std::string_view, 3> kPathWindowNames = {"all", "turning", "straight"};

/// Errors of one kind of path at one horizon: sums over moments, or means. The measures are those
/// of Argoverse 2 (Wilson et al. 2021).
struct PathErrors {
  int count = 0;               ///< moments
  double ade_m = 0.0;          ///< mean distance from the truth up to the horizon
  double fde_m = 0.0;          ///< distance from the truth at the horizon
  double brier_fde_m = 0.0;    ///< fde_m + (1 − p)², p: the path's probability; 1 of a baseline
  double missed_half_m = 0.0;  ///< share of moments with fde_m above 0.5 m
  double missed_one_m = 0.0;   ///< share of moments with fde_m above 1 m

  PathErrors& operator+=(const PathErrors& other);
};

/// [kind][horizon]
using PathTable = std::array<std::array<PathErrors, kPathHorizons_s.size()>, kPathKindNames.size()>;

/// Collects predictions, then gives their mean errors. Definitions: docs/metrics.md.
class PathScorer {
 public:
  /// Judges a prediction that was made from this estimate at time_s of the truth, at each horizon
  /// as far as the truth is known. The baselines start from the estimate. Moments without a label
  /// (see label_at()) or without a path do not count. Cost: some microseconds.
  void add(const TargetState& target, double turn_rate_rad_s, const Prediction& prediction,
           const Truth& truth, double time_s);
  /// Adds another scorer's moments.
  PathScorer& operator+=(const PathScorer& other);
  /// Mean errors over the moments of a kind.
  PathTable means(PathWindows windows) const;

 private:
  std::array<PathTable, kPathWindowNames.size()> sums_{};
};

/// The turn rate that the baseline of constant turn goes on with: of the velocity's heading over
/// the last 0.4 s.
class HeadingRate {
 public:
  /// Takes the velocity at a stamp. Returns the turn rate in rad/s, counter-clockwise; 0 for the
  /// first tenth of a second.
  double next(double stamp_s, const Vec2& velocity_m_s);

 private:
  std::vector<std::pair<double, double>> headings_;  // stamp, of the last moments
};

}  // namespace foretrack
