// SPDX-License-Identifier: Apache-2.0
#include "core/planning/see/look_ahead.hpp"

#include <algorithm>
#include <cmath>

#include "core/planning/way/map_rays.hpp"

namespace foretrack {
namespace {

constexpr double kCoast_s = 0.2;           // of the present motion is flown whatever is planned
constexpr double kWalkingSpeed_m_s = 0.2;  // below it, the velocity has no direction
constexpr double kTurnReachShare = 0.5;  // of the vehicle's reach in a step, for turning a waypoint
constexpr int kExpansionsOfOneSearch = 800;
constexpr int kOtherSideSteps = 8;  // directions tried on each side for a hidden path

class LookingAhead {
 public:
  LookingAhead(const SearchContext& context, const ExpectedTarget& expected,
               const IntentionAssessment* assessment, StageClock& clock, LookAhead& out)
      : context_(context), expected_(expected), clock_(clock), out_(out) {
    if (assessment != nullptr && context.params.horizon.intention_margins)
      margins_ = assessment->margins;
  }

  // The vehicle cannot turn at once: the way begins along its present motion.
  // To another level it rises or sinks before.
  void begin_way(const Vec3& start, const Vec3& velocity) {
    out_.way.points.assign(1, start);
    out_.way.arrival.clear();
    const Vec3 above = context_.surface.at(start.head<2>());
    if (std::abs(above.z() - start.z()) > context_.map.resolution_m) {
      out_.way.points.push_back(above);
      return;
    }
    const Vec3 coast = start + kCoast_s * velocity;
    if ((coast - start).norm() > context_.map.resolution_m &&
        is_clear(context_.map, start, coast, context_.params.path_clearance_m()))
      out_.way.points.push_back(coast);
  }

  void find_waypoints() {
    const ExpectedPath& path = expected_.paths[0];
    out_.views[0].assign(path.positions_enu_m.size(), View{});
    for (std::size_t k = 0; k < path.positions_enu_m.size(); ++k) {
      search(path.positions_enu_m[k], time_of(k));
      clock_.lap(PlanStage::kPath);
      View& view = out_.views[0][k];
      view = view_of(path.positions_enu_m[k], path.velocities_enu_m_s[k], out_.way.points.back(),
                     time_of(k));
      if (view.seen) turn_waypoint(path.positions_enu_m[k], view.shrunk);
      out_.way.arrival.push_back(static_cast<int>(out_.way.points.size()) - 1);
      clock_.lap(PlanStage::kVisibleRegions);
    }
  }

  void find_other_views() {
    for (int i = 1; i < expected_.count; ++i) {
      const ExpectedPath& path = expected_.paths[i];
      out_.views[i].assign(path.positions_enu_m.size(), View{});
      for (std::size_t k = 0; k < path.positions_enu_m.size(); ++k) {
        if (expected_.owner(i, k, context_.params.horizon.merge_distance_m) != i) continue;
        out_.views[i][k] = view_of_other(path.positions_enu_m[k], path.velocities_enu_m_s[k],
                                         out_.way.points[out_.way.arrival[k]], time_of(k));
      }
    }
  }

 private:
  double time_of(std::size_t k) const {
    return context_.start_s + context_.params.horizon.step_s * static_cast<double>(k + 1);
  }

  void search(const Vec3& target, double time_s) {
    const int left = context_.params.place.search_expansions_max - out_.search.expansions;
    const WaypointKind kind =
        search_waypoint(out_.search, context_, out_.way.points.back(), target, time_s,
                        std::clamp(left, 0, kExpansionsOfOneSearch), out_.way.points);
    out_.target_seen |= kind == WaypointKind::kSees;
    out_.path_found |= kind != WaypointKind::kNone;
  }

  View view_of(const Vec3& target, const Vec3& velocity, const Vec3& waypoint,
               double time_s) const {
    View view;
    view.seen = visible_sector(context_, target, waypoint, view.visible);
    if (!view.seen) return view;
    const Vec2 v = velocity.head<2>();
    const double heading_rad =
        v.norm() > kWalkingSpeed_m_s ? yaw_of(v) : view.visible.bisector_rad + kPi;
    view.shrunk = shrink(view.visible,
                         intention_margins(view.visible, heading_rad, margins_.left, margins_.right,
                                           context_.params.place),
                         context_.params.place.margin_share_max);
    if (context_.bearing)
      view.shrunk = narrow(view.shrunk, context_.bearing->at(time_s),
                           context_.params.framing.framing_half_angle_rad);
    return view;
  }

  // If the waypoint does not see this z_k, the nearest direction that does counts.
  View view_of_other(const Vec3& target, const Vec3& velocity, const Vec3& waypoint,
                     double time_s) const {
    View view = view_of(target, velocity, waypoint, time_s);
    const Vec2 offset = (waypoint - target).head<2>();
    for (int i = 1; i <= 2 * kOtherSideSteps && !view.seen; ++i) {
      const int steps = (i + 1) / 2;
      const double turn_rad = (i % 2 == 1 ? 1.0 : -1.0) * steps * 0.5 * kPi / kOtherSideSteps;
      const Vec2 xy =
          target.head<2>() + context_.wanted_distance_m * direction_of(yaw_of(offset) + turn_rad);
      view = view_of(target, velocity, context_.surface.at(xy), time_s);
    }
    return view;
  }

  void turn_waypoint(const Vec3& target, const ViewSector& sector) {
    const double reach_m =
        kTurnReachShare * context_.limits.speed_max_m_s * context_.params.horizon.step_s;
    const Vec3 waypoint = out_.way.points.back();
    const Vec3 moved = rotate_into(context_, target, waypoint, sector, reach_m);
    if (moved != waypoint) out_.way.points.push_back(moved);
  }

  const SearchContext& context_;
  const ExpectedTarget& expected_;
  StageClock& clock_;
  LookAhead& out_;
  MarginScores margins_;
};

}  // namespace

void look_ahead(const SearchContext& context, const Vec3& start_enu_m, const Vec3& start_velocity,
                const ExpectedTarget& expected, const IntentionAssessment* assessment,
                StageClock& clock, LookAhead& out) {
  out.target_seen = out.path_found = false;
  begin_searches(out.search, context, start_enu_m);
  LookingAhead looking(context, expected, assessment, clock, out);
  looking.begin_way(start_enu_m, start_velocity);
  looking.find_waypoints();
  looking.find_other_views();
  clock.lap(PlanStage::kVisibleRegions);
}

}  // namespace foretrack
