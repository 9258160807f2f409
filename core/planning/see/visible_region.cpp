// SPDX-License-Identifier: Apache-2.0
#include "core/planning/see/visible_region.hpp"

#include <algorithm>

#include "core/planning/way/map_rays.hpp"

namespace foretrack {
namespace {

constexpr double kInset_rad = 0.02;  // a moved waypoint lies this far inside its sector

Vec2 turned(const Vec2& v, const Vec2& by) {
  return {v.x() * by.x() - v.y() * by.y(), v.x() * by.y() + v.y() * by.x()};
}

// The line of sight from z_k towards the directions of its ring (unit vectors).
class RingSight {
 public:
  RingSight(const SearchContext& context, const Vec3& target, double radius_m)
      : context_(context), target_(target), radius_m_(radius_m) {}

  bool blocked(const Vec2& direction) const {
    return !sees(context_.map, target_,
                 context_.surface.at(target_.head<2>() + radius_m_ * direction),
                 context_.params.horizon.target_radius_m);
  }
  // True if no occupied cell is near enough to block any direction.
  bool all_free() const {
    const double far_m = std::hypot(
        radius_m_, std::abs(context_.surface.level_z_m - target_.z()) + context_.map.resolution_m);
    return context_.map.contains(target_) &&
           context_.map.occupied_distance_m(target_) - 0.9 * context_.map.resolution_m > far_m;
  }
  // How far one can rotate from the direction towards the side (+1, −1) until sight is blocked.
  double opening_rad(Vec2 direction, double side, int steps) const {
    const double step_rad = 0.5 * kPi / steps;
    const Vec2 step = direction_of(side * step_rad);
    for (int i = 0; i < steps; ++i) {
      const Vec2 next = turned(direction, step);
      if (blocked(next)) return i * step_rad + refined_rad(direction, side, step_rad);
      direction = next;
    }
    return 0.5 * kPi;
  }

 private:
  // The part of one step that is still free, to a quarter.
  double refined_rad(const Vec2& direction, double side, double step_rad) const {
    double free_rad = 0.0;
    for (const double part : {0.5, 0.25})
      if (!blocked(turned(direction, direction_of(side * (free_rad + part * step_rad)))))
        free_rad += part * step_rad;
    return free_rad;
  }

  const SearchContext& context_;
  const Vec3& target_;
  double radius_m_;
};

}  // namespace

bool visible_sector(const SearchContext& context, const Vec3& target_enu_m, const Vec3& waypoint,
                    ViewSector& sector) {
  const Vec2 offset = (waypoint - target_enu_m).head<2>();
  const RingSight sight(context, target_enu_m,
                        std::clamp(offset.norm(), context.params.place.kept_low_m(),
                                   context.params.place.kept_high_m()));
  const double angle_rad = yaw_of(offset);
  if (sight.all_free()) {
    sector = {angle_rad, 0.5 * kPi};
    return true;
  }
  const Vec2 direction = direction_of(angle_rad);
  if (sight.blocked(direction)) return false;
  const int steps = context.params.place.sector_steps;
  const double left_rad = sight.opening_rad(direction, 1.0, steps);
  const double right_rad = sight.opening_rad(direction, -1.0, steps);
  sector = {wrap_angle(angle_rad + 0.5 * (left_rad - right_rad)), 0.5 * (left_rad + right_rad)};
  return true;
}

SectorMargins intention_margins(const ViewSector& sector, double target_heading_rad,
                                double score_left, double score_right, const PlaceParams& params) {
  // 1: the vehicle is ahead of the target, 0: behind it.
  const double ahead = 0.5 * (1.0 + std::cos(sector.bisector_rad - target_heading_rad));
  const double counter_clockwise = ahead * score_left + (1.0 - ahead) * score_right;
  const double clockwise = ahead * score_right + (1.0 - ahead) * score_left;
  return {params.margin_min_rad + params.margin_extra_rad * counter_clockwise,
          params.margin_min_rad + params.margin_extra_rad * clockwise};
}

ViewSector shrink(const ViewSector& sector, const SectorMargins& margins, double share_max) {
  const double sum_rad = margins.counter_clockwise_rad + margins.clockwise_rad;
  const double most_rad = share_max * 2.0 * sector.half_angle_rad;
  const double scale = sum_rad > most_rad ? most_rad / sum_rad : 1.0;
  const double left_rad = scale * margins.counter_clockwise_rad;
  const double right_rad = scale * margins.clockwise_rad;
  return {wrap_angle(sector.bisector_rad + 0.5 * (right_rad - left_rad)),
          sector.half_angle_rad - 0.5 * (left_rad + right_rad)};
}

ViewSector narrow(const ViewSector& sector, double wanted_rad, double half_angle_rad) {
  const double half_rad = std::min(half_angle_rad, sector.half_angle_rad);
  const double most_rad = sector.half_angle_rad - half_rad;
  const double off_rad = wrap_angle(wanted_rad - sector.bisector_rad);
  return {wrap_angle(sector.bisector_rad + std::clamp(off_rad, -most_rad, most_rad)), half_rad};
}

Vec3 rotate_into(const SearchContext& context, const Vec3& target_enu_m, const Vec3& waypoint,
                 const ViewSector& sector, double reach_m) {
  const Vec2 offset = (waypoint - target_enu_m).head<2>();
  const double radius_m = offset.norm(), angle_rad = yaw_of(offset);
  const double off_rad = wrap_angle(angle_rad - sector.bisector_rad);
  const double outside_rad = std::abs(off_rad) - sector.half_angle_rad;
  if (outside_rad <= 0.0 || radius_m < 1e-3) return waypoint;
  const double wanted_rad = std::min(outside_rad + kInset_rad, std::abs(off_rad));
  const double turn_rad = std::min(wanted_rad, reach_m / radius_m);
  const double moved_rad = angle_rad - std::copysign(turn_rad, off_rad);
  const Vec3 moved =
      context.surface.at(target_enu_m.head<2>() + radius_m * direction_of(moved_rad));
  const bool reachable =
      is_clear(context.map, waypoint, moved, context.params.path_clearance_m()) &&
      sees(context.map, target_enu_m, moved, context.params.horizon.target_radius_m);
  return reachable ? moved : waypoint;
}

}  // namespace foretrack
