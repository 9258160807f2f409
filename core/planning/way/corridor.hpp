// SPDX-License-Identifier: Apache-2.0
// Convex pieces of free space around path segments (after Liu et al. 2017).
#pragma once

#include <vector>

#include "core/common/grid_map.hpp"
#include "core/common/trajectory.hpp"

namespace foretrack {

/// How large the polytopes may grow.
struct CorridorParams {
  double vehicle_radius_m = 0.3;
  double reach_m = 1.2;   // of the local box beyond the segment, horizontally
  double height_m = 0.5;  // the same, up and down
};

/// Cells near one segment that the vehicle's centre may not enter. Owned by the caller and reused.
struct CorridorWorkspace {
  /// An obstacle's cell near the segment.
  struct Blocked {
    Vec3 center;
    Vec3 nearest;  // point of the cell nearest to the segment
    double squared_m2;
  };
  std::vector<Blocked> blocked;
  std::vector<Polytope> spare;  // polytopes that are not in use, kept for their memory
};

/// Resizes without freeing or allocating planes after warm-up.
void resize_polytopes(CorridorWorkspace& workspace, std::vector<Polytope>& polytopes,
                      std::size_t count);

/// A polytope for the vehicle's centre that contains the segment and no cell whose distance to
/// occupied, unknown or outside space is below the vehicle's radius: so what lies in it passes the
/// check. Half-spaces are laid between the segment and the nearest such cell, until none is left in
/// the local box. If the segment itself touches such cells the planes pass through it (as near as
/// they can), and the result is false. Cost: tens of microseconds.
bool decompose_segment(const GridMap& map, const Vec3& from_enu_m, const Vec3& to_enu_m,
                       const CorridorParams& params, CorridorWorkspace& workspace,
                       Polytope& polytope);

}  // namespace foretrack
