// SPDX-License-Identifier: Apache-2.0
// The voxel grid that prediction and planning read: what is occupied, what is unknown, and how far
// each is.
#pragma once

#include <cstdint>
#include <vector>

#include "core/common/geometry.hpp"

namespace foretrack {

/// What a cell is, as far as it is known.
enum class Cell : std::uint8_t { kFree = 0, kOccupied = 1, kUnknown = 2 };

/// Which cells a way may lead through: those that were seen to be free, or all that are not known
/// to be occupied.
enum class Passable : std::uint8_t { kSeenFree, kNotOccupied };

/// A dense box of cubic cells with the distances of each cell to what is around it.
///
/// Values lie x fastest, then y, then z. A distance is measured from the middle of a cell to the
/// nearest face of an occupied cell (or an unfree one: occupied or unknown). It is 0 inside such a
/// cell, and 2.55 m stands for all that is farther. Outside the grid everything is unknown.
struct GridMap {
  double stamp_s = 0.0;                            ///< of the newest data in it
  double resolution_m = 0.15;                      ///< edge of a cell
  Vec3 origin_enu_m = Vec3::Zero();                ///< least corner of cell (0, 0, 0)
  Eigen::Vector3i size = Eigen::Vector3i::Zero();  ///< cells along x, y and z
  std::vector<std::uint8_t> cells;                 ///< values of Cell
  std::vector<std::uint8_t> occupied_distance_cm;  ///< filled by update_distances()
  std::vector<std::uint8_t> unfree_distance_cm;    ///< filled by update_distances()

  bool empty() const { return cells.empty(); }
  /// By the size; `cells` may still be empty.
  std::size_t cell_count() const {
    return static_cast<std::size_t>(size.x()) * size.y() * size.z();
  }
  /// The cell that holds a point; it may be outside the grid.
  Eigen::Vector3i index_of(const Vec3& point_enu_m) const {
    return ((point_enu_m - origin_enu_m) / resolution_m).array().floor().cast<int>();
  }
  /// True if the cell, or the point, is inside the grid.
  bool contains(const Eigen::Vector3i& i) const {
    return (i.array() >= 0).all() && (i.array() < size.array()).all();
  }
  bool contains(const Vec3& point_enu_m) const { return contains(index_of(point_enu_m)); }
  /// Place of a cell's values in the vectors. Precondition: the grid contains it.
  std::size_t offset_of(const Eigen::Vector3i& i) const {
    return (static_cast<std::size_t>(i.z()) * size.y() + i.y()) * size.x() + i.x();
  }
  /// The middle of a cell, world ENU.
  Vec3 center_of(const Eigen::Vector3i& i) const {
    return origin_enu_m + resolution_m * (i.cast<double>() + Vec3::Constant(0.5));
  }

  /// What is at a point; unknown outside the grid.
  Cell cell_at(const Vec3& point_enu_m) const {
    const Eigen::Vector3i i = index_of(point_enu_m);
    return contains(i) ? static_cast<Cell>(cells[offset_of(i)]) : Cell::kUnknown;
  }
  bool is_occupied(const Vec3& point_enu_m) const {
    return cell_at(point_enu_m) == Cell::kOccupied;
  }
  /// Distance to what is known to be occupied, of the cell that holds the point. 2.55 m outside the
  /// grid: nothing is known to be there.
  double occupied_distance_m(const Vec3& point_enu_m) const {
    const Eigen::Vector3i i = index_of(point_enu_m);
    return contains(i) ? 0.01 * occupied_distance_cm[offset_of(i)] : 2.55;
  }
  /// Distance to what the vehicle may not enter, occupied or unknown, of the cell that holds the
  /// point. 0 outside the grid.
  double unfree_distance_m(const Vec3& point_enu_m) const {
    const Eigen::Vector3i i = index_of(point_enu_m);
    return contains(i) ? 0.01 * unfree_distance_cm[offset_of(i)] : 0.0;
  }
  /// Distance to what is not passable; 0 outside the grid, whatever is.
  double clearance_m(const Vec3& point_enu_m, Passable passable) const {
    const Eigen::Vector3i i = index_of(point_enu_m);
    if (!contains(i)) return 0.0;
    const auto& distance_cm =
        passable == Passable::kSeenFree ? unfree_distance_cm : occupied_distance_cm;
    return 0.01 * distance_cm[offset_of(i)];
  }
};

/// Memory that update_distances() works in. Keep it between calls: then only the first one
/// allocates.
struct DistanceWorkspace {
  std::vector<std::int16_t> columns, row, padded;
  std::vector<std::uint8_t> centimetres;
};
/// Fills both distance grids from the cells: an exact Euclidean distance transform, an axis at a
/// time (Saito and Toriwaki 1994), saturated at 2.55 m (at 60 cells where they are smaller than
/// 4 cm) and rounded down to centimetres. Cost: linear in the cells, about 5 ns each.
void update_distances(GridMap& map, DistanceWorkspace& workspace);

/// True if no occupied cell lies on the segment. Unknown cells and what is outside the grid do not
/// block the sight. Cost: linear in the cells on the segment (Amanatides and Woo 1987).
bool line_of_sight(const GridMap& map, const Vec3& from_enu_m, const Vec3& to_enu_m);

/// Distance from `from` along the unit direction to the first occupied cell, at most range_m
/// (range_m: there is none). Precondition: range_m is finite. Cost as line_of_sight().
double ray_distance_m(const GridMap& map, const Vec3& from_enu_m, const Vec3& direction,
                      double range_m);

}  // namespace foretrack
