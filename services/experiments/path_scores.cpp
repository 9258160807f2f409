#include "services/experiments/path_scores.hpp"

#include <algorithm>
#include <limits>

#include "core/common/geometry.hpp"

namespace foretrack {
namespace {

constexpr double kSample_s = 0.1;
constexpr double kEvery_s = 0.2;         // between two windows
constexpr double kTurnInterval_s = 0.4;  // over which constant turn takes its rate
constexpr double kWalking_m_s = 0.3;

// Straight between the path's states; NaN beyond its end.
Vec2 point_at(const PredictedPath& path, const Vec2& start_m, double time_s) {
  double before_s = 0.0;
  Vec2 before = start_m;
  for (const PredictedState& z : path.states) {
    const Vec2 here = z.position_enu_m.head<2>();
    if (z.time_s >= time_s - 1e-9)
      return before + (here - before) * (time_s - before_s) / (z.time_s - before_s);
    before_s = z.time_s;
    before = here;
  }
  return Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
}

Vec2 turned(const Vec2& velocity, double rate_rad_s, double time_s) {
  if (std::abs(rate_rad_s) < 1e-3) return time_s * velocity;
  const double angle = rate_rad_s * time_s;
  const double s = std::sin(angle) / rate_rad_s, c = (1.0 - std::cos(angle)) / rate_rad_s;
  return {s * velocity.x() - c * velocity.y(), c * velocity.x() + s * velocity.y()};
}

void record(PathErrors& sums, double fde_m, double ade_m, double probability) {
  ++sums.count;
  sums.fde_m += fde_m;
  sums.ade_m += ade_m;
  sums.brier_fde_m += fde_m + (1.0 - probability) * (1.0 - probability);
  sums.missed_half_m += fde_m > 0.5;
  sums.missed_one_m += fde_m > 1.0;
}

template <class Samples>
double mean_error(const Samples& points, const Samples& truth, int count) {
  double sum = 0.0;
  for (int k = 0; k < count; ++k) sum += (points[k] - truth[k]).norm();
  return sum / count;
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

double PathScorer::turn_rate(const TargetState& target) {
  const double heading = yaw_of(Vec2(target.velocity_enu_m_s.head<2>()));
  headings_.emplace_back(target.stamp_s, heading);
  while (headings_.size() > 2 && headings_[1].first <= target.stamp_s - kTurnInterval_s + 1e-9)
    headings_.erase(headings_.begin());
  const double interval_s = target.stamp_s - headings_.front().first;
  return interval_s < 0.1 ? 0.0 : wrap_angle(heading - headings_.front().second) / interval_s;
}

void PathScorer::add(const TargetState& target, const Prediction& prediction) {
  if (!target.usable()) return;
  const double rate_rad_s = turn_rate(target);
  const bool early = !windows_.empty() && target.stamp_s < windows_.back().stamp_s + kEvery_s;
  if (early || prediction.paths.empty() || target.speed_m_s() < kWalking_m_s) return;
  Window& window = windows_.emplace_back();
  window.stamp_s = target.stamp_s;
  const Vec2 start = target.position_enu_m.head<2>(), velocity = target.velocity_enu_m_s.head<2>();
  for (const PredictedPath& path : prediction.paths) {
    Path& out = window.paths.emplace_back();
    out.probability = path.probability;
    for (int k = 0; k < kSamples; ++k) out.points_m[k] = point_at(path, start, (k + 1) * kSample_s);
  }
  for (int k = 0; k < kSamples; ++k) {
    const double t = (k + 1) * kSample_s;
    window.velocity_m[k] = start + t * velocity;
    window.turn_m[k] = start + turned(velocity, rate_rad_s, t);
  }
}

PathScorer::Samples PathScorer::truth_from(std::span<const FlightRow> rows, std::size_t first,
                                           double step_s, int& known) {
  Samples truth;
  truth.fill(Vec2::Zero());
  for (known = 0; known < kSamples; ++known) {
    const auto ahead = std::lround((known + 1) * kSample_s / step_s);
    const std::size_t row = first + static_cast<std::size_t>(ahead);
    if (row >= rows.size()) break;
    truth[known] = rows[row].target.position_enu_m.head<2>();
  }
  return truth;
}

void PathScorer::score(const Window& window, const Samples& truth, int known, PathTable& table) {
  for (std::size_t h = 0; h < kForesight_s.size(); ++h) {
    const int count = static_cast<int>(std::lround(kForesight_s[h] / kSample_s));
    if (count > known) return;
    const auto at = [&](PathKind kind) -> PathErrors& {
      return table[static_cast<std::size_t>(kind)][h];
    };
    const auto fde = [&](const Samples& points) {
      return (points[count - 1] - truth[count - 1]).norm();
    };
    const auto add = [&](PathKind kind, const Samples& points, double probability) {
      record(at(kind), fde(points), mean_error(points, truth, count), probability);
    };
    double best_fde_m = std::numeric_limits<double>::infinity(), best_ade_m = best_fde_m;
    double best_probability = 0.0;
    for (const Path& path : window.paths) {
      if (path.points_m[count - 1].hasNaN()) continue;
      const double fde_m = fde(path.points_m);
      if (fde_m < best_fde_m) best_fde_m = fde_m, best_probability = path.probability;
      best_ade_m = std::min(best_ade_m, mean_error(path.points_m, truth, count));
    }
    if (!std::isfinite(best_fde_m)) return;
    const Path& first = window.paths.front();
    add(PathKind::kMostProbable, first.points_m, first.probability);
    record(at(PathKind::kBest), best_fde_m, best_ade_m, best_probability);
    add(PathKind::kConstantVelocity, window.velocity_m, 1.0);
    add(PathKind::kConstantTurn, window.turn_m, 1.0);
  }
}

PathTable PathScorer::scores(std::span<const FlightRow> rows) const {
  PathTable table{};
  if (rows.size() < 2) return table;
  const double first_s = rows.front().now_s;
  const double step_s = (rows.back().now_s - first_s) / static_cast<double>(rows.size() - 1);
  for (const Window& window : windows_) {
    const double index = std::round((window.stamp_s - first_s) / step_s);
    if (index < 0.0 || index >= static_cast<double>(rows.size())) continue;
    const auto row = static_cast<std::size_t>(index);
    if (rows[row].target.velocity_enu_m_s.head<2>().norm() < kWalking_m_s) continue;
    int known = 0;
    const Samples truth = truth_from(rows, row, step_s, known);
    score(window, truth, known, table);
  }
  return table;
}

}  // namespace foretrack
