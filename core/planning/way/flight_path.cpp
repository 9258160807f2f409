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
constexpr double kNarrowShare = 0.4;  // of the speed counted on: so much slower is worth a segment
constexpr double kStretch_m = 0.6;    // that is at least so long
constexpr double kWider_m = 0.03;     // than the tube, where there is room
constexpr double kStarted_m = 0.3;    // of way that is flown whatever is planned

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

double widest_m(const SearchContext& context) {
  return context.tube.radius_m(context.limits.speed_max_m_s) + kWider_m;
}

void measure_rooms(const SearchContext& context, const WaypointPath& way, FlightPathWorkspace& w) {
  w.rooms_m.resize(way.points.size());
  for (std::size_t i = 0; i < way.points.size(); ++i)
    w.rooms_m[i] = context.map.unfree_distance_m(way.points[i]);
}

// Where a segment from there must end: what is narrow is not longer than it is. It begins and ends
// where it is wide.
std::size_t end_of_stretch(const SearchContext& context, const FlightPathWorkspace& w,
                           std::size_t from, std::size_t end, double longest_m) {
  const double narrow_m =
      context.tube.radius_m(kNarrowShare * kSpeedShare * context.limits.speed_max_m_s);
  const auto is_narrow = [&](std::size_t i) { return w.rooms_m[i] < narrow_m; };
  std::size_t last = from + 1;
  for (bool narrow = is_narrow(last); last < end; ++last) {
    if (w.arc_m[last + 1] - w.arc_m[from] > longest_m) break;
    if (is_narrow(last + 1) == narrow) continue;
    if (w.arc_m[last] - w.arc_m[from] > kStretch_m) return narrow ? last + 1 : last;
    narrow = true;  // what is short is part of it
  }
  return last;
}

// The furthest point that can be flown to straight: by doubling, then halving. The straight way
// comes hardly nearer to obstacles than the way does, and not at all where that is too near.
std::size_t furthest_straight(const SearchContext& context, const WaypointPath& way,
                              const FlightPathWorkspace& w, std::size_t from, std::size_t last) {
  const double wide_m = widest_m(context), least_m = context.params.path_clearance_m();
  const double nearer_m = 0.5 * context.map.resolution_m;
  const auto straight = [&](std::size_t to) {
    const double way_m = *std::min_element(w.rooms_m.begin() + static_cast<std::ptrdiff_t>(from),
                                           w.rooms_m.begin() + static_cast<std::ptrdiff_t>(to) + 1);
    const double required_m =
        std::min(way_m, std::clamp(way_m - nearer_m, least_m, std::max(wide_m, least_m)));
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

// The room of a segment. Where the vehicle is, it is already: what counts is where it goes.
double room_m(const SearchContext& context, const Vec3& from, const Vec3& to, bool first) {
  const double length_m = (to - from).norm();
  const double skip_m = first ? std::min(kStarted_m, 0.5 * length_m) : 0.0;
  const Vec3 begin = length_m > 0.0 ? Vec3(from + skip_m / length_m * (to - from)) : from;
  return least_clearance_m(context.map, begin, to, widest_m(context));
}

void add_segment(const SearchContext& context, const Vec3& from, const Vec3& to, double wanted_s,
                 FlightPath& path) {
  const double room = room_m(context, from, to, path.rooms_m.empty());
  const double least_s =
      std::max(kMinSegment_s, (to - from).norm() / context.tube.speed_within_m_s(room - kWider_m));
  path.vertices.push_back(to);
  path.times_s.push_back(std::max(path.times_s.back() + least_s, wanted_s));
  path.rooms_m.push_back(room);
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
  measure_rooms(context, way, w);
  const double end_m = std::min(w.arc_m.back(), w.schedule_m.back() + kOverrun_s * speed_m_s);
  const int wanted = std::clamp(static_cast<int>(std::ceil(end_m / params.place.segment_max_m)), 1,
                                params.place.polytopes_max);
  const double longest_m = end_m / wanted + 1.5 * context.map.resolution_m;

  path.vertices.assign(1, way.points.front());
  path.times_s.assign(1, 0.0);
  path.rooms_m.clear();
  const auto end_index = static_cast<std::size_t>(
      std::lower_bound(w.arc_m.begin(), w.arc_m.end(), end_m - 1e-9) - w.arc_m.begin());
  for (std::size_t at = 0;
       at < end_index && static_cast<int>(path.vertices.size()) <= params.place.polytopes_max;) {
    const std::size_t last = end_of_stretch(context, w, at, end_index, longest_m);
    const Vec3 from = way.points[at];
    at = furthest_straight(context, way, w, at, last);
    add_segment(context, from, way.points[at], time_at(w, w.arc_m[at], step_s, speed_m_s), path);
  }
  if (path.vertices.size() == 1) {
    add_segment(context, path.vertices.front(), path.vertices.front(), 0.0, path);
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
