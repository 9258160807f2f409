// SPDX-License-Identifier: Apache-2.0
#include "core/scores/score_paths.hpp"

#include <algorithm>
#include <limits>

namespace foretrack {
namespace {

constexpr double kSample_s = 0.1;
constexpr double kTurnInterval_s = 0.4;
constexpr std::size_t kSamples = 30;
using Samples = std::array<Vec2, kSamples>;

Vec2 turned(const Vec2& velocity, double rate_rad_s, double time_s) {
  if (std::abs(rate_rad_s) < 1e-3) return time_s * velocity;
  const double angle = rate_rad_s * time_s;
  const double s = std::sin(angle) / rate_rad_s, c = (1.0 - std::cos(angle)) / rate_rad_s;
  return {s * velocity.x() - c * velocity.y(), c * velocity.x() + s * velocity.y()};
}

template <class PointAt>
Samples samples_of(PointAt&& point) {
  Samples samples;
  for (std::size_t k = 0; k < kSamples; ++k)
    samples[k] = point(static_cast<double>(k + 1) * kSample_s);
  return samples;
}

struct Judged {
  Samples points_m;
  double probability = 1.0;
};

struct Error {
  double fde_m = std::numeric_limits<double>::infinity();
  double ade_m = std::numeric_limits<double>::infinity();
  double probability = 0.0;
};

Error error_of(const Judged& path, const Samples& truth_m, std::size_t count) {
  Error e{(path.points_m[count - 1] - truth_m[count - 1]).norm(), 0.0, path.probability};
  for (std::size_t k = 0; k < count; ++k)
    e.ade_m += (path.points_m[k] - truth_m[k]).norm() / static_cast<double>(count);
  return e;
}

PathErrors errors_of(const Error& e) {
  const double doubt = 1.0 - e.probability;
  return {1,
          e.ade_m,
          e.fde_m,
          e.fde_m + doubt * doubt,
          e.fde_m > 0.5 ? 1.0 : 0.0,
          e.fde_m > 1.0 ? 1.0 : 0.0};
}

// All kinds at one horizon; paths: the most probable first.
std::array<PathErrors, kPathKindNames.size()> judge(const std::vector<Judged>& paths,
                                                    const Judged& straight, const Judged& turn,
                                                    const Samples& truth_m, std::size_t count) {
  Error best;
  for (const Judged& path : paths) {
    const Error e = error_of(path, truth_m, count);
    if (e.fde_m < best.fde_m) best.fde_m = e.fde_m, best.probability = e.probability;
    best.ade_m = std::min(best.ade_m, e.ade_m);
  }
  return {errors_of(error_of(paths.front(), truth_m, count)), errors_of(best),
          errors_of(error_of(straight, truth_m, count)), errors_of(error_of(turn, truth_m, count))};
}

}  // namespace

PathErrors& PathErrors::operator+=(const PathErrors& o) {
  count += o.count;
  ade_m += o.ade_m;
  fde_m += o.fde_m;
  brier_fde_m += o.brier_fde_m;
  missed_half_m += o.missed_half_m;
  missed_one_m += o.missed_one_m;
  return *this;
}

void PathScorer::add(const TargetState& target, double turn_rate_rad_s,
                     const Prediction& prediction, const Truth& truth, double time_s) {
  if (prediction.paths.empty() || !truth.knows(time_s)) return;
  const int now = truth.steps(time_s);
  const auto label = label_at(truth, now);
  if (!label) return;
  const Vec2 start = target.position_enu_m.head<2>(), velocity = target.velocity_enu_m_s.head<2>();
  std::vector<Judged> paths;
  for (const PredictedPath& path : prediction.paths)
    paths.push_back(
        {samples_of([&](double t) -> Vec2 { return path.at(t).position_enu_m.head<2>(); }),
         path.probability});
  const Judged straight{samples_of([&](double t) -> Vec2 { return start + t * velocity; })};
  const Judged turn{
      samples_of([&](double t) -> Vec2 { return start + turned(velocity, turn_rate_rad_s, t); })};
  const Samples truth_m = samples_of([&](double t) -> Vec2 {
    return truth.knows(time_s + t) ? truth.at(time_s + t).position_m : Vec2(Vec2::Zero());
  });
  const std::array<bool, kPathWindowNames.size()> counts = {true, is_turn(*label),
                                                            goes_straight(truth, now)};
  for (std::size_t h = 0; h < kPathHorizons_s.size(); ++h) {
    if (!truth.knows(time_s + kPathHorizons_s[h])) break;
    const auto count = static_cast<std::size_t>(std::lround(kPathHorizons_s[h] / kSample_s));
    const auto errors = judge(paths, straight, turn, truth_m, count);
    for (std::size_t w = 0; w < counts.size(); ++w)
      for (std::size_t kind = 0; counts[w] && kind < errors.size(); ++kind)
        sums_[w][kind][h] += errors[kind];
  }
}

PathScorer& PathScorer::operator+=(const PathScorer& other) {
  for (std::size_t w = 0; w < sums_.size(); ++w)
    for (std::size_t kind = 0; kind < sums_[w].size(); ++kind)
      for (std::size_t h = 0; h < sums_[w][kind].size(); ++h)
        sums_[w][kind][h] += other.sums_[w][kind][h];
  return *this;
}

PathTable PathScorer::means(PathWindows windows) const {
  PathTable table = sums_[static_cast<std::size_t>(windows)];
  for (auto& row : table)
    for (PathErrors& e : row)
      for (double* sum : {&e.ade_m, &e.fde_m, &e.brier_fde_m, &e.missed_half_m, &e.missed_one_m})
        *sum /= std::max(1, e.count);
  return table;
}

double HeadingRate::next(double stamp_s, const Vec2& velocity_m_s) {
  const double heading = yaw_of(velocity_m_s);
  headings_.emplace_back(stamp_s, heading);
  while (headings_.size() > 2 && headings_[1].first <= stamp_s - kTurnInterval_s + 1e-9)
    headings_.erase(headings_.begin());
  const double interval_s = stamp_s - headings_.front().first;
  return interval_s < 0.1 ? 0.0 : wrap_angle(heading - headings_.front().second) / interval_s;
}

}  // namespace foretrack
