// SPDX-License-Identifier: Apache-2.0
// The dense box of a MappingState: its place, its cells, and the octree behind it.
#pragma once

#include "core/mapping/update_map.hpp"

namespace foretrack {

/// Stands in MappingState::log_odds for a cell of which nothing is known.
inline constexpr std::int8_t kUnknownLogOdds = -128;
inline constexpr float kNeverFree_s = -1e9F;

/// The box's size in cells, at least one on each axis.
Eigen::Vector3i box_size(const MappingParams& params);

/// Puts the box around the vehicle if it has no place yet, or if the vehicle is farther than a
/// scroll step from its centre on any axis. Cells that come into the box are read from the octree.
/// At the edge of the octree (32768 cells from the origin) the box stops. True if it moved. The
/// distances are not renewed.
bool follow_vehicle(MappingState& state, const Vec3& vehicle_enu_m, const MappingParams& params);

/// Sets a cell's log-odds (at least 0: occupied). If that makes it another class of cell, the map
/// and the octree are told. True if it did. `offset`: as GridMap::offset_of() has it.
bool set_log_odds(MappingState& state, std::size_t offset, std::int8_t log_odds);

/// Reads the whole box from the octree again.
void reload_box(MappingState& state, const MappingParams& params);

/// Log-odds in the box's steps of 0.05, at most ±127 of them.
std::int8_t log_odds_steps(double log_odds);

}  // namespace foretrack
