// SPDX-License-Identifier: Apache-2.0
// Intention-driven hybrid A* (paper §IV): one path for one root intention.
#pragma once

#include <cstdint>
#include <vector>

#include "core/common/grid_map.hpp"
#include "core/prediction/intentions/intention_table.hpp"

namespace foretrack {

struct SearchNode {
  PlanarState state;
  double cost = 0.0;         // g: Λ summed along the path
  double turned_rad = 0.0;   // since the root, > 0: to the left
  double clearance_m = 0.0;  // that its arcs must keep from obstacles
  std::int32_t parent = -1;
  std::int16_t step = 0;  // k of its time kΔ
  Intention intention{};  // of the primitive that led here
};

/// Owned by the caller; nothing is allocated once it has grown to the expansion bound.
struct SearchWorkspace {
  struct Open {
    double estimate = 0.0;  // f = g + h
    std::int32_t node = 0;
    std::int16_t step = 0;
  };
  struct Seen {
    std::uint64_t key = 0;
    double cost = 0.0;
    std::uint32_t search = 0;  // entries of other searches are empty
  };
  std::vector<SearchNode> nodes;
  std::vector<Open> open;  // heap
  std::vector<Seen> seen;  // open addressing
  std::uint32_t search = 0;
  std::vector<std::int32_t> path;  // nodes of the last path found, k = 1 … N_p
};

struct SearchRequest {
  PlanarState start;
  double height_m = 0.0;         // at which the map is read
  double recent_turn_rad = 0.0;  // counts towards the largest turn of the root intention
  Intention root{};
};

enum class SearchStatus : std::uint8_t { kFound, kImpossible, kExhausted };
struct SearchOutcome {
  SearchStatus status = SearchStatus::kImpossible;
  int expansions = 0;
};

/// Finds the cheapest path of N_p steps for the root intention; workspace.path holds its nodes.
/// Cost: at most max_expansions expansions of one arc for each intention.
SearchOutcome search_path(const SearchRequest& request, const GridMap& map,
                          const PredictionParams& params, SearchWorkspace& workspace,
                          IntentionTable table = kIntentions);

/// True if a disc that moves along the arc keeps this far from occupied cells. The distance grid
/// bounds how far the next sample may be, so that no part of the arc is skipped.
bool arc_is_free(const GridMap& map, double height_m, const MotionModel& model,
                 const PlanarState& start, double duration_s, double clearance_m);

}  // namespace foretrack
