// SPDX-License-Identifier: Apache-2.0
// How good predicted paths were, beside constant velocity and constant turn.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "core/common/target.hpp"
#include "core/scores/truth.hpp"

namespace foretrack {

inline constexpr std::array<double, 4> kPathHorizons_s = {0.5, 1.0, 2.0, 3.0};

enum class PathKind : std::uint8_t { kMostProbable, kBest, kConstantVelocity, kConstantTurn };
inline constexpr std::array<std::string_view, 4> kPathKindNames = {
    "most probable", "best of K", "constant velocity", "constant turn"};

/// Which moments are judged: all of a walking target, those whose label is a turn, and those that
/// three seconds of straight walking follow.
enum class PathWindows : std::uint8_t { kAll, kTurning, kStraight };
inline constexpr std::array<std::string_view, 3> kPathWindowNames = {"all", "turning", "straight"};

/// Sums, or means, over windows at one horizon.
struct PathErrors {
  int count = 0;
  double ade_m = 0.0;
  double fde_m = 0.0;
  double brier_fde_m = 0.0;  // + (1 − p)², p of the path that is meant; baselines have p = 1
  double missed_half_m = 0.0;
  double missed_one_m = 0.0;

  PathErrors& operator+=(const PathErrors& other);
};

/// [kind][horizon]
using PathTable = std::array<std::array<PathErrors, kPathHorizons_s.size()>, kPathKindNames.size()>;

class PathScorer {
 public:
  /// Judges a prediction made from this estimate at time_s of the truth, as far as the truth is
  /// known. The baselines start from the estimate as it is. Cost: some microseconds.
  void add(const TargetState& target, double turn_rate_rad_s, const Prediction& prediction,
           const Truth& truth, double time_s);
  PathScorer& operator+=(const PathScorer& other);
  PathTable means(PathWindows windows) const;

 private:
  std::array<PathTable, kPathWindowNames.size()> sums_{};
};

/// Turn rate of the velocity over the last 0.4 s: the baseline's.
class HeadingRate {
 public:
  double next(double stamp_s, const Vec2& velocity_m_s);

 private:
  std::vector<std::pair<double, double>> headings_;  // stamp, of the last moments
};

}  // namespace foretrack
