// SPDX-License-Identifier: Apache-2.0
#include "bench/prediction/turn_backs.hpp"

#include <algorithm>

namespace foretrack::bench {
namespace {

constexpr double kLeastBack_m = 4.0, kMostBack_m = 12.0;

/// A polyline by the way along it.
class Route {
 public:
  explicit Route(const std::vector<Vec2>& points_m) : points_m_(points_m) {
    at_m_.push_back(0.0);
    for (std::size_t i = 1; i < points_m.size(); ++i)
      at_m_.push_back(at_m_.back() + (points_m[i] - points_m[i - 1]).norm());
  }
  double length_m() const { return at_m_.back(); }
  Vec2 at(double along_m) const {
    const auto after = std::ranges::upper_bound(at_m_, along_m);
    const auto i = std::clamp<std::ptrdiff_t>(after - at_m_.begin(), 1,
                                              static_cast<std::ptrdiff_t>(at_m_.size()) - 1);
    const double part = (along_m - at_m_[i - 1]) / (at_m_[i] - at_m_[i - 1]);
    return points_m_[i - 1] + std::clamp(part, 0.0, 1.0) * (points_m_[i] - points_m_[i - 1]);
  }
  /// Adds what lies between two places, either way round, and the latter.
  void append(double from_m, double to_m, std::vector<Vec2>& line) const {
    const auto first = line.end() - line.begin();
    const auto [low, high] = std::minmax(from_m, to_m);
    for (std::size_t i = 0; i < at_m_.size(); ++i)
      if (at_m_[i] > low + 1e-6 && at_m_[i] < high - 1e-6) line.push_back(points_m_[i]);
    if (to_m < from_m) std::reverse(line.begin() + first, line.end());
    line.push_back(at(to_m));
  }
  /// The same place, or one nearby that is no corner.
  double beside_corners(double along_m) const {
    constexpr double kBeside_m = 0.6;
    for (const double corner_m : at_m_)
      if (std::abs(along_m - corner_m) < kBeside_m) return std::max(0.0, corner_m - kBeside_m);
    return along_m;
  }

 private:
  const std::vector<Vec2>& points_m_;
  std::vector<double> at_m_;
};

/// Puts together what is walked without a stop, and what happens in between.
class Writer {
 public:
  Writer(const Vec2& start_m, const WalkLimits& limits) : limits_(limits), line_m_{start_m} {}

  std::vector<Vec2>& line() { return line_m_; }

  void turn_round(TurnManner manner, Random& random) {
    if (manner == TurnManner::kArc) return add_arc(random);
    if (manner == TurnManner::kPivot) return;
    const bool steps_back = manner == TurnManner::kStepBack;
    finish_line();
    stand(steps_back ? random.uniform(0.02, 0.4) : random.uniform(0.1, 1.5));
    const double now_s = result_.walk.duration_s();
    if (steps_back) result_.backward.push_back({now_s, now_s + random.uniform(0.6, 1.8)});
  }

  ReturningWalk finish() {
    finish_line();
    return std::move(result_);
  }

 private:
  // Half a circle to the left or right.
  void add_arc(Random& random) {
    constexpr int kPieces = 8;
    const double radius_m = random.uniform(0.2, 0.45), side = random.chance(0.5) ? 1.0 : -1.0;
    const Vec2 end = line_m_.back();
    const double course_rad = yaw_of(Vec2(end - line_m_[line_m_.size() - 2]));
    const Vec2 middle = end + side * radius_m * direction_of(course_rad + kPi / 2.0);
    for (int i = 1; i <= kPieces; ++i) {
      const double angle_rad = course_rad + side * (i * kPi / kPieces - kPi / 2.0);
      line_m_.push_back(middle + radius_m * direction_of(angle_rad));
    }
  }
  void finish_line() {
    const Walk part = walk_along(line_m_, limits_);
    const double start_s = result_.walk.duration_s();
    for (WalkPiece piece : part.pieces) {
      piece.start_s += start_s;
      result_.walk.pieces.push_back(piece);
    }
    line_m_ = {line_m_.back()};
  }
  void stand(double for_s) {
    WalkPiece piece{.start_s = result_.walk.duration_s(), .duration_s = for_s};
    piece.coefficients_m[0] = line_m_.back();
    result_.walk.pieces.push_back(piece);
  }

  WalkLimits limits_;
  std::vector<Vec2> line_m_;
  ReturningWalk result_;
};

// Most do not stand. Otherwise a stop, of which there are few in the walks that heads are fitted
// on, would mean a turn back.
TurnManner any_manner(Random& random) {
  const double x = random.uniform();
  if (x < 0.35) return TurnManner::kPivot;
  if (x < 0.65) return TurnManner::kArc;
  return x < 0.85 ? TurnManner::kStand : TurnManner::kStepBack;
}

// Where the next turn back is.
double next_turn_m(const Route& route, double from_m, const ReturnRequest& request,
                   Random& random) {
  if (request.only_at_the_end) return route.length_m() - random.uniform(0.0, 1.0);
  const double forth_m = std::max(kLeastBack_m, random.uniform(0.5, 1.5) * request.forth_m);
  return route.beside_corners(from_m + forth_m);
}

}  // namespace

ReturningWalk walk_and_return(const std::vector<Vec2>& route_m, const ReturnRequest& request,
                              Random& random) {
  const Route route(route_m);
  Writer writer(route_m.front(), {.speed_m_s = request.speed_m_s});
  const double length_m = request.speed_m_s * request.duration_s;
  double at_m = 0.0, walked_m = 0.0;
  while (walked_m < length_m) {
    const double there_m = next_turn_m(route, at_m, request, random);
    if (there_m >= route.length_m()) break;
    route.append(at_m, there_m, writer.line());
    writer.turn_round(any_manner(random), random);
    const double back_m = random.uniform(kLeastBack_m, kMostBack_m);
    const double back_at_m = route.beside_corners(std::max(0.0, there_m - back_m));
    route.append(there_m, back_at_m, writer.line());
    writer.turn_round(any_manner(random), random);
    walked_m += there_m - at_m + there_m - back_at_m;
    at_m = back_at_m;
  }
  if (at_m < route.length_m()) route.append(at_m, route.length_m(), writer.line());
  return writer.finish();
}

}  // namespace foretrack::bench
