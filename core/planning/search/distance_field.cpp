// SPDX-License-Identifier: Apache-2.0
#include "core/planning/search/distance_field.hpp"

#include <algorithm>

namespace foretrack {
namespace {}  // namespace

void reserve(DistanceField& field) {
  field.steps.assign(static_cast<std::size_t>(kGroundSide) * kGroundSide, DistanceField::kNever);
}

void reserve(FieldQueue& queue) {
  queue.cells.reserve(static_cast<std::size_t>(kGroundSide) * kGroundSide);
}

void begin_field(DistanceField& field, FieldQueue& queue, int goal) {
  std::ranges::fill(field.steps, DistanceField::kNever);
  field.goal = goal;
  field.complete = false;
  field.steps[goal] = 0;
  queue.cells.assign(1, goal);
  queue.next = 0;
}

int downhill(const DistanceField& field, int cell) {
  int best = cell;
  const auto offer = [&](int to) {
    if (field.steps[to] < field.steps[best]) best = to;
  };
  const auto open = [&](int to) { return field.steps[to] != DistanceField::kNever; };
  for (const int dy : {-kGroundSide, 0, kGroundSide})
    for (const int dx : {-1, 0, 1})
      if ((dx == 0 || dy == 0) || (open(cell + dx) && open(cell + dy))) offer(cell + dx + dy);
  return best;
}

}  // namespace foretrack
