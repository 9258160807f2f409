// How good the predicted paths are, beside constant velocity and constant turn.
#pragma once

#include <array>
#include <string_view>

#include "bench/prediction/labels.hpp"
#include "core/prediction/predict.hpp"

namespace foretrack::bench {

inline constexpr std::array<double, 4> kHorizons_s = {0.5, 1.0, 2.0, 3.0};

enum class Method : std::uint8_t { kConstantVelocity, kConstantTurn, kMostProbable, kBestOfPaths };
inline constexpr std::array<std::string_view, 4> kMethodNames = {
    "constant velocity", "constant turn", "most probable path", "best of the paths"};

/// Sums over windows, at one horizon.
struct PathErrors {
  int count = 0;
  double fde_m = 0.0;
  double ade_m = 0.0;
  double brier_fde_m = 0.0;  // + (1 − p)² of the path that is meant
  double missed_half_m = 0.0;
  double missed_one_m = 0.0;
};

/// [method][horizon], means.
using PathTable = std::array<std::array<PathErrors, kHorizons_s.size()>, kMethodNames.size()>;

class PathScorer {
 public:
  /// Precondition: the truth reaches 3 s beyond truth[i].
  void add(const TargetState& target, double turn_rate_rad_s, const Prediction& prediction,
           const std::vector<TruthSample>& truth, int i);
  PathTable means() const;
  int count() const { return sums_[0][0].count; }

 private:
  PathTable sums_{};
};

}  // namespace foretrack::bench
