// SPDX-License-Identifier: Apache-2.0
// What others are told of a search: a few numbers, and the belief in cells of a metre.
#pragma once

#include <array>
#include <cstdint>

#include "core/common/geometry.hpp"

namespace foretrack {

struct LostPerson;
struct PlanningParams;

/// Whether somebody is looked for.
enum class SearchMode : std::uint8_t {
  kNone,       ///< nobody is lost
  kSearching,  ///< the vehicle flies to where it may see them
  kWaiting     ///< the search has lasted too long: it stands and looks
};

/// World ENU. Without a search, all but mode and stamp is nothing.
struct SearchSummary {
  static constexpr int kCells = 48;  ///< at most, along x and along y

  SearchMode mode = SearchMode::kNone;
  double stamp_s = 0.0;
  double unseen_s = 0.0;
  Vec3 likeliest_enu_m = Vec3::Zero();
  bool has_viewpoint = false;
  Vec3 viewpoint_enu_m = Vec3::Zero();
  double gaze_rad = 0.0;
  double speed_max_m_s = 0.0;
  Vec2 corner_m = Vec2::Zero();  ///< least corner of the first cell
  double cell_m = 1.0;
  int columns = 0, rows = 0;
  /// columns · rows values, x fastest; 255: the likeliest cell.
  std::array<std::uint8_t, kCells * kCells> belief{};
};

/// Sums up what is believed now. Belief outside of the cells counts in the outermost ones. Cost:
/// 10 µs.
void summarize(const LostPerson& lost, double now_s, const PlanningParams& params,
               SearchSummary& out);

}  // namespace foretrack
