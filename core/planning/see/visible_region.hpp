// SPDX-License-Identifier: Apache-2.0
// Sectors in which the predicted target is seen (paper §V.A).
#pragma once

#include "core/planning/way/waypoint_search.hpp"

namespace foretrack {

/// The directions within half_angle_rad of the bisector; angles in the world's plane.
struct ViewSector {
  double bisector_rad = 0.0;
  double half_angle_rad = 0.0;
  bool contains(double angle_rad) const {
    return std::abs(wrap_angle(angle_rad - bisector_rad)) <= half_angle_rad;
  }
};

/// Margins at the two sides of a sector, in the plane seen from above.
struct SectorMargins {
  double counter_clockwise_rad = 0.0;
  double clockwise_rad = 0.0;
};

/// V_k: from z_k, rotates left and right from the direction of the waypoint, at its distance, until
/// the line of sight is blocked, at most a quarter turn. Returns false if the waypoint itself is
/// not seen. Edges are found to a quarter of a ray's step. Cost: nothing is cast if the whole disc
/// is free; else about 2 · sector_steps rays.
bool visible_sector(const SearchContext& context, const Vec3& target_enu_m, const Vec3& waypoint,
                    ViewSector& sector);

/// θ_εl and θ_εr as sides of a sector. The left margin lies on the target's left: seen from above
/// that is the clockwise side of a vehicle behind the target, the other one of a vehicle ahead.
/// Scores are Π_tl and Π_tr.
SectorMargins intention_margins(const ViewSector& sector, double target_heading_rad,
                                double score_left, double score_right, const PlaceParams& params);

/// V̂_k: the sector without its margins, which are scaled down together if they would take more than
/// margin_share_max of it.
ViewSector shrink(const ViewSector& sector, const SectorMargins& margins, double share_max);

/// The part of the sector within half_angle_rad of the wanted direction; where there is none, or
/// less than that wide, the nearest part of that width. A narrower sector is left as it is.
ViewSector narrow(const ViewSector& sector, double wanted_rad, double half_angle_rad);

/// The waypoint on the nearest direction inside the sector, at its distance from the target, at
/// most reach_m away. Unchanged if the way there is not clear or the target not seen from there.
Vec3 rotate_into(const SearchContext& context, const Vec3& target_enu_m, const Vec3& waypoint,
                 const ViewSector& sector, double reach_m);

}  // namespace foretrack
