// SPDX-License-Identifier: Apache-2.0
#include "services/convert/visual.hpp"

#include <algorithm>
#include <optional>

#include "core/prediction/intentions/intention_table.hpp"
#include "services/convert/geometry.hpp"

namespace foretrack {
namespace {

using visualization_msgs::msg::Marker;
using visualization_msgs::msg::MarkerArray;
namespace kinds = visualization_msgs::msg::Marker_Constants;

constexpr double kLine_m = 0.04;
constexpr double kPathStep_s = 0.1;
constexpr double kArcStep_rad = kPi / 36.0;

struct Color {
  float r, g, b, a;
};
constexpr Color kTarget{0.9f, 0.3f, 0.2f, 0.8f};
constexpr Color kSector{0.95f, 0.75f, 0.2f, 0.6f};
constexpr Color kVisible{0.2f, 0.7f, 0.9f, 0.4f};
constexpr Color kCorridor{0.6f, 0.6f, 0.6f, 0.3f};
constexpr Color kFlown{0.1f, 0.8f, 0.3f, 1.0f};

Color color_of(std::uint32_t rgb, float alpha) {
  const auto part = [&](int shift) { return static_cast<float>(rgb >> shift & 0xFF) / 255.0f; };
  return {part(16), part(8), part(0), alpha};
}

Marker& add_marker(MarkerArray& out, double stamp_s, const char* ns, int type, Color color) {
  const auto id = static_cast<std::int32_t>(out.markers().size());
  Marker& m = out.markers().emplace_back();
  set_header(m.header(), stamp_s);
  m.ns(ns);
  m.id(id);
  m.type(type);
  m.action(kinds::ADD);
  m.pose().orientation().w(1.0);
  m.scale().x(kLine_m);
  m.color().r(color.r);
  m.color().g(color.g);
  m.color().b(color.b);
  m.color().a(color.a);
  m.lifetime().nanosec(500'000'000);  // an old drawing goes by itself
  return m;
}

void add_point(Marker& marker, const Vec3& point) {
  set_xyz(marker.points().emplace_back(), point);
}

// The outline of a sector as a closed strip.
void add_sector(Marker& strip, const Vec3& center, double radius_m, double bisector_rad,
                double half_angle_rad) {
  add_point(strip, center);
  const int steps = std::max(2, static_cast<int>(2.0 * half_angle_rad / kArcStep_rad));
  for (int i = 0; i <= steps; ++i) {
    const double yaw = bisector_rad + half_angle_rad * (2.0 * i / steps - 1.0);
    add_point(strip, center + radius_m * Vec3(std::cos(yaw), std::sin(yaw), 0.0));
  }
  add_point(strip, center);
}

void add_region(MarkerArray& out, double stamp_s, const char* ns, const ReachableRegion& r) {
  Marker& left = add_marker(out, stamp_s, ns, kinds::LINE_STRIP, kSector);
  add_sector(left, r.center_enu_m, r.radius_m, r.left_bisector_rad(), r.left_half_angle_rad);
  Marker& right = add_marker(out, stamp_s, ns, kinds::LINE_STRIP, kSector);
  add_sector(right, r.center_enu_m, r.radius_m, r.right_bisector_rad(), r.right_half_angle_rad);
}

struct Segment {
  Vec3 from, to;
};

// The part of the line where two faces meet that lies within all the others.
std::optional<Segment> edge_between(const Polytope& p, std::size_t a, std::size_t b) {
  const Vec3 na = p.planes[a].head<3>(), nb = p.planes[b].head<3>();
  const Vec3 along = na.cross(nb);
  if (along.norm() < 1e-6) return std::nullopt;
  Mat3 rows;
  rows << na.transpose(), nb.transpose(), along.transpose();
  const Vec3 origin = rows.inverse() * Vec3(p.planes[a][3], p.planes[b][3], 0.0);
  double low = -1e3, high = 1e3;
  for (std::size_t i = 0; i < p.planes.size(); ++i) {
    if (i == a || i == b) continue;
    const double slope = p.planes[i].head<3>().dot(along);
    const double room = p.planes[i][3] - p.planes[i].head<3>().dot(origin);
    if (std::abs(slope) < 1e-9) {
      if (room < -1e-9) return std::nullopt;
    } else if (slope > 0.0) {
      high = std::min(high, room / slope);
    } else {
      low = std::max(low, room / slope);
    }
  }
  if (high - low < 1e-6) return std::nullopt;
  return Segment{origin + low * along, origin + high * along};
}

void add_edges(Marker& lines, const Polytope& polytope) {
  for (std::size_t a = 0; a < polytope.planes.size(); ++a)
    for (std::size_t b = a + 1; b < polytope.planes.size(); ++b)
      if (const auto edge = edge_between(polytope, a, b)) {
        add_point(lines, edge->from);
        add_point(lines, edge->to);
      }
}

geometry_msgs::msg::PoseStamped& add_pose(nav_msgs::msg::Path& out, double stamp_s,
                                          const Vec3& position, double yaw_rad) {
  auto& pose = out.poses().emplace_back();
  set_header(pose.header(), stamp_s);
  set_xyz(pose.pose().position(), position);
  set_orientation(pose.pose().orientation(), Quat(Eigen::AngleAxisd(yaw_rad, Vec3::UnitZ())));
  return pose;
}

}  // namespace

void to_path(const Prediction& in, nav_msgs::msg::Path& out) {
  set_header(out.header(), in.stamp_s);
  out.poses().clear();
  if (in.paths.empty()) return;
  for (const auto& state : in.paths.front().states)
    add_pose(out, in.stamp_s + state.time_s, state.position_enu_m,
             yaw_of(Vec2(state.velocity_enu_m_s.head<2>())));
}

void to_path(const PlannedTrajectory& in, nav_msgs::msg::Path& out) {
  set_header(out.header(), in.stamp_s);
  out.poses().clear();
  if (in.pieces.empty()) return;
  const int steps = static_cast<int>(std::ceil(in.duration_s() / kPathStep_s));
  for (int i = 0; i <= steps; ++i) {
    const double t = std::min(i * kPathStep_s, in.duration_s());
    const double yaw = in.yaw.nodes.empty() ? 0.0 : in.yaw.at(t).angle_rad;
    add_pose(out, in.start_s + t, in.position(t), yaw);
  }
}

void to_markers(const TargetState& target, MarkerArray& out) {
  out.markers().clear();
  if (target.status == TrackStatus::kNone) return;
  Marker& body = add_marker(out, target.stamp_s, "target", kinds::CYLINDER, kTarget);
  if (!target.usable()) body.color().a(0.2f);
  set_xyz(body.pose().position(), target.position_enu_m - Vec3(0.0, 0.0, 0.35));
  set_xyz(body.scale(), Vec3(0.5, 0.5, 1.7));
}

void to_markers(const IntentionAssessment& intention, const Prediction& prediction,
                MarkerArray& out) {
  out.markers().clear();
  if (intention.region.radius_m > 0.0) {
    add_region(out, intention.stamp_s, "reachable", intention.region);
    add_region(out, intention.stamp_s, "reachable_ahead", intention.region_ahead);
  }
  for (const auto& path : prediction.paths) {
    const auto alpha = static_cast<float>(0.15 + 0.85 * path.probability);
    const Color color = color_of(row_of(path.intention).color_rgb, alpha);
    Marker& line = add_marker(out, prediction.stamp_s, "predicted", kinds::LINE_STRIP, color);
    for (const auto& state : path.states) add_point(line, state.position_enu_m);
  }
}

void to_markers(const PlannedTrajectory& plan, MarkerArray& out) {
  out.markers().clear();
  for (const auto& region : plan.visible_regions) {
    Marker& strip = add_marker(out, plan.stamp_s, "visible", kinds::LINE_STRIP, kVisible);
    const double radius_m = distance_xy(region.waypoint_enu_m, region.target_enu_m);
    add_sector(strip, region.target_enu_m, radius_m, region.bisector_rad, region.half_angle_rad);
  }
  if (!plan.corridor.empty()) {
    Marker& lines = add_marker(out, plan.stamp_s, "corridor", kinds::LINE_LIST, kCorridor);
    for (const auto& polytope : plan.corridor) add_edges(lines, polytope);
  }
  if (plan.pieces.empty()) return;
  Marker& line = add_marker(out, plan.stamp_s, "plan", kinds::LINE_STRIP, kFlown);
  for (double t = 0.0; t <= plan.duration_s(); t += kPathStep_s) add_point(line, plan.position(t));
}

}  // namespace foretrack
