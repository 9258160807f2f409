// How good predicted paths were, beside constant velocity and constant turn.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/common/target.hpp"
#include "services/flight/flight_row.hpp"

namespace foretrack {

enum class PathKind : std::uint8_t { kMostProbable, kBest, kConstantVelocity, kConstantTurn };
inline constexpr std::array<std::string_view, 4> kPathKindNames = {
    "most probable", "best of K", "constant velocity", "constant turn"};

/// Sums over windows, at one horizon.
struct PathErrors {
  int count = 0;
  double ade_m = 0.0;
  double fde_m = 0.0;
  double brier_fde_m = 0.0;  // + (1 − p)², p of the path that is meant; baselines have p = 1
  double missed_half_m = 0.0;
  double missed_one_m = 0.0;

  PathErrors& operator+=(const PathErrors& other);
};

/// [kind][horizon of kForesight_s]
using PathTable = std::array<std::array<PathErrors, kForesight_s.size()>, kPathKindNames.size()>;

/// Collects the predictions of a flight, a few a second, and judges them when its truth is known.
class PathScorer {
 public:
  /// Shows each prediction as it is made. Predictions without paths are left out.
  void add(const TargetState& target, const Prediction& prediction);
  /// Windows of a walking target whose future is within the rows. Cost: linear in the windows.
  PathTable scores(std::span<const FlightRow> rows) const;

 private:
  static constexpr int kSamples = 30;  // every 0.1 s
  using Samples = std::array<Vec2, kSamples>;
  struct Path {
    double probability = 0.0;
    Samples points_m;
  };
  struct Window {
    double stamp_s = 0.0;
    std::vector<Path> paths;  // most probable first
    Samples velocity_m, turn_m;
  };
  double turn_rate(const TargetState& target);
  static Samples truth_from(std::span<const FlightRow> rows, std::size_t first, double step_s,
                            int& known);
  static void score(const Window& window, const Samples& truth_m, int known, PathTable& table);

  std::vector<Window> windows_;
  std::vector<std::pair<double, double>> headings_;  // stamp, of the last moments
};

}  // namespace foretrack
