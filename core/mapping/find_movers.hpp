// SPDX-License-Identifier: Apache-2.0
// What moves against the map: returns of a depth image where it is free, or was until lately.
#pragma once

#include <cstdint>
#include <vector>

#include "core/common/body_sighting.hpp"
#include "core/common/grid_map.hpp"
#include "core/mapping/params.hpp"

namespace foretrack {

/// Returns of one image that stand in the open, by column of the map. Its memory is kept.
struct MoverColumns {
  /// One column of the image.
  struct Column {
    int count = 0;
    float low_m = 0.0F, high_m = 0.0F;  ///< lowest and highest return
    Vec2 sum_m = Vec2::Zero();          ///< of their places from the map's origin
    Mat2 sum_squares_m2 = Mat2::Zero();
    bool visited = false;
  };
  std::vector<Column> columns;         ///< x fastest
  std::vector<std::uint32_t> touched;  ///< those with returns
  std::vector<std::uint32_t> stack;
};

/// A return in column (x, y) of the map.
void add_return(MoverColumns& movers, const GridMap& map, const Vec3& point_enu_m);

/// Columns that are as high as a body, joined where they touch, as upright cylinders seen from
/// `eye_enu_m`; empties the columns. The return of a cylinder is its near face: its middle is
/// behind (by π/4 of the radius on average), and its radius is √3 of the spread across the sight.
/// Cost: linear in the returns' columns.
void find_movers(MoverColumns& movers, const GridMap& map, const Vec3& eye_enu_m,
                 const MappingParams& params, BodySightings& out);

}  // namespace foretrack
