// SPDX-License-Identifier: Apache-2.0
// A square of ground around the place where a person was lost: what they cannot walk through, what
// hides them, and where they can be at all.
#pragma once

#include <cstdint>
#include <vector>

#include "core/common/grid_map.hpp"

namespace foretrack {

inline constexpr int kGroundSide = 400;  // cells

/// Cells coincide with the map's columns. A cell is a number: y · kGroundSide + x. World ENU. The
/// cells of the border are walls. What the map does not know may be walked and looked through.
struct SearchGround {
  static constexpr std::uint8_t kWall = 1;    // nobody walks through
  static constexpr std::uint8_t kScreen = 2;  // a person behind it is hidden

  double resolution_m = 0.15;
  Vec2 corner_m = Vec2::Zero();       // least corner of cell 0
  double torso_m = 1.2;               // z of the person's torso
  std::vector<std::uint8_t> what;     // bits
  std::vector<std::uint8_t> may_be;   // 1: the person can have come here since they were seen
  std::vector<std::uint8_t> looks;    // in vain, one after the other
  std::vector<std::uint8_t> look_of;  // the last look that saw the cell
  std::vector<std::uint8_t> scratch;
  double map_stamp_s = -1.0;  // of the map that was read last
  std::uint8_t look = 0;      // number of the last look
  double to_spread_m = 0.0;   // less than a cell
  int spreads = 0;

  /// −1: outside.
  int cell_of(const Vec2& p) const {
    const int x = static_cast<int>(std::floor((p.x() - corner_m.x()) / resolution_m));
    const int y = static_cast<int>(std::floor((p.y() - corner_m.y()) / resolution_m));
    return x < 0 || y < 0 || x >= kGroundSide || y >= kGroundSide ? -1 : y * kGroundSide + x;
  }
  Vec2 center_of(int cell) const {
    const int row = cell / kGroundSide, column = cell % kGroundSide;
    return corner_m + resolution_m * Vec2(column + 0.5, row + 0.5);
  }
  bool is_walkable(int cell) const { return cell >= 0 && (what[cell] & kWall) == 0; }
};

/// Takes the memory.
void reserve(SearchGround& ground);

/// Lays the square around the torso's last place; the person is there. Cost: a millisecond.
void begin_ground(SearchGround& ground, const GridMap& map, const Vec3& torso_enu_m);

/// Reads a map that is newer than the last one. What was read before and is not in it stays; beyond
/// a map that is known (stamp 0) is nothing. Cost: 5 ns a column.
void read_map(SearchGround& ground, const GridMap& map);

/// The person can have gone so much farther, around walls. Cost: 20 µs a cell of distance.
void spread(SearchGround& ground, double distance_m);

/// Nobody was seen within range and the half angle of a direction: after three such looks in a row
/// nobody is there. Cost: 50 µs.
void look_in_vain(SearchGround& ground, const Vec2& from_m, double yaw_rad, double half_angle_rad,
                  double range_m);

/// True if nothing between the two hides a person.
bool is_in_sight(const SearchGround& ground, const Vec2& from_m, const Vec2& to_m);

/// Distance to the nearest place in sight where the person can be, within the half angle of a
/// direction; range_m if there is none.
double free_ahead_m(const SearchGround& ground, const Vec2& from_m, double yaw_rad,
                    double half_angle_rad, double range_m);

}  // namespace foretrack
