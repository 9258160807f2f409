// SPDX-License-Identifier: Apache-2.0
#include "core/planning/way/cut_bodies.hpp"

#include <algorithm>

namespace foretrack {
namespace {

constexpr double kBodyTime_s = 0.25;
constexpr double kWayRoom_m = 0.1;          // beside the segment, that is left to it
constexpr std::size_t kPlanesOfAll = 48;  // of one polytope

// One segment, and what is beside it.
struct Beside {
  const Vec3 &from, &to;
  const GapParams& params;

  Vec3 nearest_to(const Vec3& foot) const {
    const Vec2 span = (to - from).head<2>();
    const double along = (foot - from).head<2>().dot(span) / std::max(span.squaredNorm(), 1e-9);
    return from + std::clamp(along, 0.0, 1.0) * (to - from);
  }
  // How much of the gap there is room for; negative: none.
  double gap_m(const Vec3& foot, const MovingBody& body) const {
    const double apart_m = distance_xy(foot, nearest_to(foot));
    return std::min(params.gap_min_m, apart_m - kWayRoom_m - params.hull_radius_m - body.radius_m);
  }
  bool is_above(const Vec3& foot, const MovingBody& body) const {
    return std::min(from.z(), to.z()) >
           foot.z() + body.height_m + params.hull_radius_m + params.gap_min_m;
  }
  void cut(const Vec3& foot, const MovingBody& body, Polytope& polytope) const {
    const Vec3 near = nearest_to(foot);
    const Vec2 normal = (foot - near).head<2>().normalized();
    const double touch_m = params.hull_radius_m + body.radius_m;
    const Vec2 touched = foot.head<2>() - touch_m * normal;
    if (!polytope.contains({touched.x(), touched.y(), near.z()})) return;
    const double end_m = normal.dot(foot.head<2>()) - touch_m - gap_m(foot, body);
    polytope.planes.emplace_back(normal.x(), normal.y(), 0.0, end_m);
  }
};

}  // namespace

void cut_bodies(const SearchContext& context, const Vec3& from_enu_m, const Vec3& to_enu_m,
                double from_s, double to_s, Polytope& polytope) {
  if (context.courses == nullptr) return;
  const Beside beside{from_enu_m, to_enu_m, context.params.body};
  for (const BodyCourse& course : context.courses->all()) {
    const MovingBody& body = course.body;
    const double until_s = std::min(to_s, course.horizon_s);
    const auto foot_at = [&](double t_s) { return body.expected_at(context.start_s + t_s); };
    bool apart = true;
    for (double t_s = from_s; apart && t_s <= until_s; t_s += kBodyTime_s)
      apart = beside.gap_m(foot_at(t_s), body) >= 0.0 && !beside.is_above(foot_at(t_s), body);
    for (double t_s = from_s; apart && t_s <= until_s; t_s += kBodyTime_s)
      if (polytope.planes.size() < kPlanesOfAll) beside.cut(foot_at(t_s), body, polytope);
  }
}

}  // namespace foretrack
