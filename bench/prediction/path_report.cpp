#include "bench/prediction/path_report.hpp"

#include <algorithm>
#include <limits>

namespace foretrack::bench {
namespace {

constexpr double kSample_s = 0.1;

// Predicted position after t, straight between the states of a path.
Vec2 position_at(const PredictedPath& path, const TargetState& target, double t) {
  double before_s = 0.0;
  Vec2 before = target.position_enu_m.head<2>();
  for (const PredictedState& z : path.states) {
    const Vec2 here = z.position_enu_m.head<2>();
    if (z.time_s >= t - 1e-9)
      return before + (here - before) * (t - before_s) / (z.time_s - before_s);
    before_s = z.time_s;
    before = here;
  }
  return before;
}

struct Error {
  double fde_m = 0.0, ade_m = 0.0;
};

template <class PositionAt>
Error error_of(PositionAt&& predicted, const std::vector<TruthSample>& truth, int i,
               double horizon_s) {
  Error e;
  const int samples = static_cast<int>(horizon_s / kSample_s + 0.5);
  for (int k = 1; k <= samples; ++k) {
    const double t = k * kSample_s;
    const int j = i + static_cast<int>(t / kTruthStep_s + 0.5);
    e.fde_m = (predicted(t) - truth[j].position_m).norm();
    e.ade_m += e.fde_m / samples;
  }
  return e;
}

void record(PathErrors& sums, const Error& e, double probability) {
  ++sums.count;
  sums.fde_m += e.fde_m;
  sums.ade_m += e.ade_m;
  sums.brier_fde_m += e.fde_m + (1.0 - probability) * (1.0 - probability);
  sums.missed_half_m += e.fde_m > 0.5;
  sums.missed_one_m += e.fde_m > 1.0;
}

}  // namespace

void PathScorer::add(const TargetState& target, double turn_rate_rad_s,
                     const Prediction& prediction, const std::vector<TruthSample>& truth, int i) {
  const PlanarState start{target.position_enu_m.head<2>(), target.velocity_enu_m_s.head<2>()};
  const auto along = [&](const MotionModel& model) {
    return [&start, model](double t) { return advance(model, start, t).position_m; };
  };
  for (std::size_t h = 0; h < kHorizons_s.size(); ++h) {
    const double horizon_s = kHorizons_s[h];
    const auto sums_of = [&](Method m) -> PathErrors& { return sums_[static_cast<int>(m)][h]; };
    record(sums_of(Method::kConstantVelocity),
           error_of(along(MotionModel::constant_velocity()), truth, i, horizon_s), 1.0);
    record(sums_of(Method::kConstantTurn),
           error_of(along(MotionModel::turn(turn_rate_rad_s)), truth, i, horizon_s), 1.0);
    Error best{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
    double best_probability = 0.0;
    for (const PredictedPath& path : prediction.paths) {
      const Error e =
          error_of([&](double t) { return position_at(path, target, t); }, truth, i, horizon_s);
      if (&path == &prediction.paths.front())
        record(sums_of(Method::kMostProbable), e, path.probability);
      if (e.fde_m < best.fde_m) best.fde_m = e.fde_m, best_probability = path.probability;
      best.ade_m = std::min(best.ade_m, e.ade_m);
    }
    record(sums_of(Method::kBestOfPaths), best, best_probability);
  }
}

PathTable PathScorer::means() const {
  PathTable table = sums_;
  for (auto& row : table)
    for (PathErrors& e : row) {
      const double n = std::max(1, e.count);
      e.fde_m /= n, e.ade_m /= n, e.brier_fde_m /= n, e.missed_half_m /= n, e.missed_one_m /= n;
    }
  return table;
}

}  // namespace foretrack::bench
