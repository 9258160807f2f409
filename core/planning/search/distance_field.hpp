// SPDX-License-Identifier: Apache-2.0
// Distances over the search's ground to one place, found a bounded number of cells at a time.
#pragma once

#include <limits>

#include "core/planning/search/search_ground.hpp"

namespace foretrack {

/// Steps between neighbouring cells, around what is in the way.
struct DistanceField {
  static constexpr std::uint16_t kNever = std::numeric_limits<std::uint16_t>::max();

  int goal = -1;                     // cell; −1: none yet
  bool complete = false;             // all cells that lead to the goal have their distance
  std::vector<std::uint16_t> steps;  // of each cell
};

/// The cells that were reached, nearest first: a queue, and after it the cells to choose from.
struct FieldQueue {
  std::vector<std::int32_t> cells;
  int next = 0;  // to be expanded
};

/// Takes the memory.
void reserve(DistanceField& field);
void reserve(FieldQueue& queue);

/// Begins anew from a goal. Cost: 20 µs.
void begin_field(DistanceField& field, FieldQueue& queue, int goal);

/// Expands up to so many cells, none beyond most_steps, through cells for which may_pass is true.
template <class MayPass>
void grow_field(DistanceField& field, FieldQueue& queue, int expansions, int most_steps,
                MayPass&& may_pass) {
  constexpr int kMoves[] = {1, -1, kGroundSide, -kGroundSide};
  for (int i = 0; i < expansions && queue.next < static_cast<int>(queue.cells.size()); ++i) {
    const int cell = queue.cells[queue.next++];
    const auto steps = static_cast<std::uint16_t>(field.steps[cell] + 1);
    if (steps > most_steps) continue;
    for (const int move : kMoves) {
      const int to = cell + move;
      if (field.steps[to] != DistanceField::kNever || !may_pass(to)) continue;
      field.steps[to] = steps;
      queue.cells.push_back(to);
    }
  }
  field.complete = queue.next == static_cast<int>(queue.cells.size());
}

/// The neighbour of the cell, on eight sides, that is nearest to the goal; itself at the goal or
/// where nothing leads there. Corners are not cut.
int downhill(const DistanceField& field, int cell);

}  // namespace foretrack
