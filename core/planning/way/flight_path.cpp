// SPDX-License-Identifier: Apache-2.0
#include "core/planning/way/flight_path.hpp"

#include <algorithm>
#include <cmath>

#include "core/planning/way/map_rays.hpp"

namespace foretrack {
namespace {

constexpr double kSpeedShare = 0.85;        // of the greatest speed, that the first guess counts on
constexpr double kAccelerationShare = 0.5;  // the same, of the acceleration
constexpr double kOverrun_s = 0.6;          // of way after the horizon that is still planned
constexpr double kMinSegment_s = 0.2;

void measure(const std::vector<Vec3>& points, std::vector<double>& arc_m) {
  arc_m.resize(points.size());
  arc_m[0] = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i)
    arc_m[i] = arc_m[i - 1] + (points[i] - points[i - 1]).norm();
}

// Where on the way the vehicle can be at each t_k: no further than waypoint k, no faster than it
// can.
void schedule(const SearchContext& context, const WaypointPath& way, double start_speed_m_s,
              FlightPathWorkspace& w) {
  const double step_s = context.params.horizon.step_s;
  const double speed_max = kSpeedShare * context.limits.speed_max_m_s;
  const double gain = kAccelerationShare * context.limits.acceleration_max_m_s2 * step_s;
  double speed_m_s = start_speed_m_s, at_m = 0.0;
  w.schedule_m.assign(1, 0.0);
  for (const int index : way.arrival) {
    const double faster_m_s = std::min(speed_max, speed_m_s + gain);
    const double next_m = std::clamp(w.arc_m[index], at_m, at_m + faster_m_s * step_s);
    speed_m_s = (next_m - at_m) / step_s;
    at_m = next_m;
    w.schedule_m.push_back(at_m);
  }
}

// The furthest point that can be flown to straight: by doubling, then halving. On the way out of a
// blocked start, the straight way must not come nearer to obstacles than it begins.
std::size_t furthest_straight(const SearchContext& context, const WaypointPath& way,
                              std::size_t from, std::size_t last) {
  const double required_m =
      std::min(context.params.path_clearance_m(), context.map.unfree_distance_m(way.points[from]));
  const auto straight = [&](std::size_t to) {
    return is_clear(context.map, way.points[from], way.points[to], required_m);
  };
  std::size_t good = from + 1, stride = 1;
  while (good < last && straight(std::min(good + stride, last))) {
    good = std::min(good + stride, last);
    stride *= 2;
  }
  for (stride /= 2; stride >= 1 && good < last; stride /= 2)
    if (good + stride <= last && straight(good + stride)) good += stride;
  return good;
}

double time_at(const FlightPathWorkspace& w, double arc_m, double step_s, double speed_m_s) {
  const auto it = std::lower_bound(w.schedule_m.begin(), w.schedule_m.end(), arc_m - 1e-9);
  const double horizon_s = step_s * static_cast<double>(w.schedule_m.size() - 1);
  if (it == w.schedule_m.end()) return horizon_s + (arc_m - w.schedule_m.back()) / speed_m_s;
  const auto k = static_cast<std::size_t>(it - w.schedule_m.begin());
  if (k == 0) return 0.0;
  const double part =
      (arc_m - w.schedule_m[k - 1]) / std::max(w.schedule_m[k] - w.schedule_m[k - 1], 1e-9);
  return step_s * (static_cast<double>(k) - 1.0 + std::clamp(part, 0.0, 1.0));
}

}  // namespace

void make_flight_path(const SearchContext& context, const WaypointPath& way, double start_speed_m_s,
                      FlightPathWorkspace& w, FlightPath& path) {
  const PlanningParams& params = context.params;
  const double speed_m_s = kSpeedShare * context.limits.speed_max_m_s;
  const double step_s = params.horizon.step_s;
  measure(way.points, w.arc_m);
  schedule(context, way, start_speed_m_s, w);
  const double end_m = std::min(w.arc_m.back(), w.schedule_m.back() + kOverrun_s * speed_m_s);
  const int wanted = std::clamp(static_cast<int>(std::ceil(end_m / params.place.segment_max_m)), 1,
                                params.place.polytopes_max);
  const double longest_m = end_m / wanted + 1.5 * context.map.resolution_m;

  path.vertices.assign(1, way.points.front());
  path.times_s.assign(1, 0.0);
  const auto end_index = static_cast<std::size_t>(
      std::lower_bound(w.arc_m.begin(), w.arc_m.end(), end_m - 1e-9) - w.arc_m.begin());
  for (std::size_t at = 0;
       at < end_index && static_cast<int>(path.vertices.size()) <= params.place.polytopes_max;) {
    std::size_t last = at + 1;
    while (last < end_index && w.arc_m[last + 1] - w.arc_m[at] <= longest_m) ++last;
    at = furthest_straight(context, way, at, last);
    path.vertices.push_back(way.points[at]);
    path.times_s.push_back(
        std::max(path.times_s.back() + kMinSegment_s, time_at(w, w.arc_m[at], step_s, speed_m_s)));
  }
  if (path.vertices.size() == 1) {
    path.vertices.push_back(path.vertices.front());
    path.times_s.push_back(0.0);
  }
  const double horizon_s = step_s * static_cast<double>(way.arrival.size());
  path.times_s.back() = std::max(path.times_s.back(), horizon_s);
}

Vec3 scheduled_position(const WaypointPath& way, const FlightPathWorkspace& w, std::size_t k) {
  const double arc_m = w.schedule_m[std::min(k, w.schedule_m.size() - 1)];
  const auto next = std::upper_bound(w.arc_m.begin(), w.arc_m.end(), arc_m);
  if (next == w.arc_m.end()) return way.points.back();
  const auto i = static_cast<std::size_t>(next - w.arc_m.begin());
  const double part = (arc_m - w.arc_m[i - 1]) / (w.arc_m[i] - w.arc_m[i - 1]);
  return way.points[i - 1] + part * (way.points[i] - way.points[i - 1]);
}

}  // namespace foretrack
