// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/local_box.hpp"

#include <algorithm>
#include <cmath>

#include "core/mapping/octree_cells.hpp"

namespace foretrack {
namespace {

using Vec3i = Eigen::Vector3i;

constexpr double kStep = 0.05;

std::uint8_t class_of(std::int8_t log_odds) {
  if (log_odds == kUnknownLogOdds) return static_cast<std::uint8_t>(Cell::kUnknown);
  return static_cast<std::uint8_t>(log_odds >= 0 ? Cell::kOccupied : Cell::kFree);
}

Vec3i index_of(const MappingState& state, std::size_t offset) {
  const auto nx = static_cast<std::size_t>(state.map.size.x());
  const auto ny = static_cast<std::size_t>(state.map.size.y());
  return state.base + Vec3i(static_cast<int>(offset % nx), static_cast<int>(offset / nx % ny),
                            static_cast<int>(offset / (nx * ny)));
}

// Reads the cells in [low, high) of the box from the octree.
void read_cells(MappingState& state, const Vec3i& low, const Vec3i& high,
                const MappingParams& params) {
  if ((low.array() >= high.array()).any()) return;
  const std::int8_t free = log_odds_steps(params.min_log_odds);
  const std::int8_t seen = log_odds_steps(params.max_log_odds);
  for_each_leaf(*state.tree, state.base + low, state.base + high,
                [&](bool occupied, const Vec3i& from, const Vec3i& to) {
                  for (int z = from.z(); z < to.z(); ++z)
                    for (int y = from.y(); y < to.y(); ++y) {
                      const Vec3i first = low + Vec3i(from.x(), y, z);
                      std::fill_n(state.log_odds.begin() + state.map.offset_of(first),
                                  to.x() - from.x(), occupied ? seen : free);
                    }
                });
}

void place(MappingState& state, const Vec3i& base) {
  state.base = base;
  state.map.origin_enu_m = base.cast<double>() * state.map.resolution_m;
}

void classify_all(MappingState& state) {
  std::transform(state.log_odds.begin(), state.log_odds.end(), state.map.cells.begin(), class_of);
}

// Moves what the old and the new box share to its new place; the rest is `unknown`. `spare` is
// the memory of the next call.
template <class T>
void shift_cells(const GridMap& map, const Vec3i& shift, T unknown, std::vector<T>& values,
                 std::vector<T>& spare) {
  spare.assign(values.size(), unknown);
  const Vec3i low = (-shift).cwiseMax(0), high = (map.size - shift).cwiseMin(map.size);
  for (int z = low.z(); z < high.z(); ++z)
    for (int y = low.y(); y < high.y(); ++y) {
      if (low.x() >= high.x()) continue;
      const std::size_t to = map.offset_of({low.x(), y, z});
      const std::size_t from = map.offset_of(Vec3i(low.x(), y, z) + shift);
      std::copy_n(values.begin() + from, high.x() - low.x(), spare.begin() + to);
    }
  std::swap(values, spare);
}

// Reads the slabs of the box that were outside it before the shift, an axis at a time.
void read_new_slabs(MappingState& state, const Vec3i& shift, const MappingParams& params) {
  Vec3i low = Vec3i::Zero(), high = state.map.size;
  for (int a = 0; a < 3; ++a) {
    if (shift[a] == 0) continue;
    Vec3i slab_low = low, slab_high = high;
    if (shift[a] > 0)
      slab_low[a] = high[a] = std::max(low[a], high[a] - shift[a]);
    else
      slab_high[a] = low[a] = std::min(high[a], low[a] - shift[a]);
    read_cells(state, slab_low, slab_high, params);
  }
}

}  // namespace

std::int8_t log_odds_steps(double log_odds) {
  return static_cast<std::int8_t>(std::clamp(std::lround(log_odds / kStep), -127L, 127L));
}

Vec3i box_size(const MappingParams& params) {
  const auto cells = [&](double length_m) {
    return std::max(1, static_cast<int>(std::lround(length_m / params.resolution_m)));
  };
  return {cells(params.box_width_m), cells(params.box_width_m), cells(params.box_height_m)};
}

bool set_log_odds(MappingState& state, std::size_t offset, std::int8_t log_odds) {
  state.log_odds[offset] = log_odds;
  const std::uint8_t now = class_of(log_odds);
  if (now == state.map.cells[offset]) return false;
  state.map.cells[offset] = now;
  const bool occupied = now == static_cast<std::uint8_t>(Cell::kOccupied);
  state.tree->setNodeValue(
      key_of(index_of(state, offset)),
      occupied ? state.tree->getClampingThresMaxLog() : state.tree->getClampingThresMinLog());
  return true;
}

void reload_box(MappingState& state, const MappingParams& params) {
  std::fill(state.log_odds.begin(), state.log_odds.end(), kUnknownLogOdds);
  read_cells(state, Vec3i::Zero(), state.map.size, params);
  classify_all(state);
}

bool follow_vehicle(MappingState& state, const Vec3& vehicle_enu_m, const MappingParams& params) {
  const double resolution_m = state.map.resolution_m;
  const Vec3 half_m = 0.5 * resolution_m * state.map.size.cast<double>();
  const Vec3 off_centre_m = vehicle_enu_m - (state.map.origin_enu_m + half_m);
  if (state.placed && off_centre_m.cwiseAbs().maxCoeff() <= params.scroll_step_m) return false;
  const Vec3i wanted =
      ((vehicle_enu_m - half_m) / resolution_m).array().round().cast<int>().matrix();
  const Vec3i limit = Vec3i::Constant(kTreeCentre) - state.map.size;
  const Vec3i base = wanted.cwiseMax(-limit).cwiseMin(limit);
  const Vec3i shift = base - state.base;
  if (state.placed && shift.isZero()) return false;
  place(state, base);
  if (!state.placed) {
    state.placed = true;
    reload_box(state, params);
    return true;
  }
  shift_cells(state.map, shift, kUnknownLogOdds, state.log_odds, state.shifted);
  shift_cells(state.map, shift, kNeverFree_s, state.free_s, state.shifted_free_s);
  read_new_slabs(state, shift, params);
  classify_all(state);
  return true;
}

}  // namespace foretrack
