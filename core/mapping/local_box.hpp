// SPDX-License-Identifier: Apache-2.0
// The dense box of a MappingState: its place, its cells, and the octree behind it.
#pragma once

#include "core/mapping/update_map.hpp"

namespace foretrack {

inline constexpr std::int8_t kUnknownLogOdds = -128;

/// The box's size in cells.
Eigen::Vector3i box_size(const MappingParams& params);

/// Puts the box around the vehicle if it has no place yet or the vehicle is farther than a scroll
/// step from its centre. Cells that come into the box are read from the octree. True if it moved.
bool follow_vehicle(MappingState& state, const Vec3& vehicle_enu_m, const MappingParams& params);

/// Sets a cell's log-odds; if its class changes, in the map and the octree too. True if it did.
bool set_log_odds(MappingState& state, std::size_t offset, std::int8_t log_odds);

/// Reads the whole box from the octree again.
void reload_box(MappingState& state, const MappingParams& params);

/// Log-odds in the box's steps.
std::int8_t log_odds_steps(double log_odds);

}  // namespace foretrack
