// SPDX-License-Identifier: Apache-2.0
// The voxel grid that prediction and planning read: what is occupied, what is unknown, and how far
// each is.
#pragma once

#include <cstdint>
#include <vector>

#include "core/common/geometry.hpp"

namespace foretrack {

enum class Cell : std::uint8_t { kFree = 0, kOccupied = 1, kUnknown = 2 };

/// A dense box of cubic cells, x fastest, then y, then z. Distances are centimetres, saturated at
/// 255, from a cell's centre to the nearest face of an occupied (or unfree: occupied or unknown)
/// cell, 0 inside one. Outside the grid everything is unknown.
struct GridMap {
  double stamp_s = 0.0;
  double resolution_m = 0.15;
  Vec3 origin_enu_m = Vec3::Zero();  // least corner of cell (0, 0, 0)
  Eigen::Vector3i size = Eigen::Vector3i::Zero();
  std::vector<std::uint8_t> cells;  // of Cell
  std::vector<std::uint8_t> occupied_distance_cm;
  std::vector<std::uint8_t> unfree_distance_cm;

  bool empty() const { return cells.empty(); }
  std::size_t cell_count() const {
    return static_cast<std::size_t>(size.x()) * size.y() * size.z();
  }
  Eigen::Vector3i index_of(const Vec3& point_enu_m) const {
    return ((point_enu_m - origin_enu_m) / resolution_m).array().floor().cast<int>();
  }
  bool contains(const Eigen::Vector3i& i) const {
    return (i.array() >= 0).all() && (i.array() < size.array()).all();
  }
  bool contains(const Vec3& point_enu_m) const { return contains(index_of(point_enu_m)); }
  std::size_t offset_of(const Eigen::Vector3i& i) const {
    return (static_cast<std::size_t>(i.z()) * size.y() + i.y()) * size.x() + i.x();
  }
  Vec3 center_of(const Eigen::Vector3i& i) const {
    return origin_enu_m + resolution_m * (i.cast<double>() + Vec3::Constant(0.5));
  }

  Cell cell_at(const Vec3& point_enu_m) const {
    const Eigen::Vector3i i = index_of(point_enu_m);
    return contains(i) ? static_cast<Cell>(cells[offset_of(i)]) : Cell::kUnknown;
  }
  bool is_occupied(const Vec3& point_enu_m) const {
    return cell_at(point_enu_m) == Cell::kOccupied;
  }
  /// Distance to what is known to be occupied, of the cell that holds the point; 2.55 outside the
  /// grid.
  double occupied_distance_m(const Vec3& point_enu_m) const {
    const Eigen::Vector3i i = index_of(point_enu_m);
    return contains(i) ? 0.01 * occupied_distance_cm[offset_of(i)] : 2.55;
  }
  /// Distance to what the vehicle may not enter: occupied or unknown; 0 outside the grid.
  double unfree_distance_m(const Vec3& point_enu_m) const {
    const Eigen::Vector3i i = index_of(point_enu_m);
    return contains(i) ? 0.01 * unfree_distance_cm[offset_of(i)] : 0.0;
  }
};

/// Fills both distance grids from the cells (exact Euclidean transform, saturated). Cost: linear in
/// the cells. `workspace` is kept between calls so that nothing is allocated after the first one.
struct DistanceWorkspace {
  std::vector<std::int16_t> columns, row, padded;
  std::vector<std::uint8_t> centimetres;
};
void update_distances(GridMap& map, DistanceWorkspace& workspace);

/// True if no occupied cell lies on the segment (cell traversal); unknown cells do not block sight.
bool line_of_sight(const GridMap& map, const Vec3& from_enu_m, const Vec3& to_enu_m);

/// Distance from `from` along the unit direction to the first occupied cell, at most range_m
/// (range_m: none).
double ray_distance_m(const GridMap& map, const Vec3& from_enu_m, const Vec3& direction,
                      double range_m);

}  // namespace foretrack
