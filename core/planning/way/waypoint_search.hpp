// SPDX-License-Identifier: Apache-2.0
// Path searches to places that see the predicted target (paper §V; the occlusion-free region).
#pragma once

#include <cstdint>
#include <vector>

#include "core/planning/frame_target.hpp"
#include "core/planning/motion/keep_clear.hpp"
#include "core/planning/way/flight_surface.hpp"

namespace foretrack {

/// Nodes of a square window of map columns around the vehicle, stamped with the search that wrote
/// them so that nothing is cleared between searches. Owned by the caller and reused.
struct SearchState {
  /// A cell that was reached.
  struct Node {
    std::uint32_t search = 0;
    std::int32_t parent = -1;
    float cost_m = 0.0F;
    std::uint8_t clearance_cm = 0;
    bool closed = false;
  };
  /// A node that waits to be expanded.
  struct Open {
    float estimate_m;
    std::int32_t node;
    bool operator<(const Open& other) const { return estimate_m > other.estimate_m; }
  };
  std::vector<Node> nodes;
  std::vector<Open> open;
  std::uint32_t search = 0;
  Eigen::Vector2i corner = Eigen::Vector2i::Zero();  // map column of node (0, 0)
  int expansions = 0;                                // since begin_searches
};

/// What all searches of one plan share.
struct SearchContext {
  const GridMap& map;
  const FlightSurface& surface;
  const PlanningParams& params;
  const FlightLimits& limits;              // the plan's own: a search is slower than the parameters
  double wanted_distance_m = 2.0;          // radius of the ring around the target
  double ring_tolerance_m = 0.2;           // its half width
  const BodyCourses* courses = nullptr;    // everybody who moves; null: nobody
  double start_s = 0.0;                    // absolute time at which the way begins
  const WantedBearing* bearing = nullptr;  // of the vehicle from the target; null: free
};

/// What a waypoint was found for.
enum class WaypointKind : std::uint8_t {
  kSees,     // on the ring, with free line of sight
  kNearest,  // no such place was found: as near to the ring as known free space goes
  kNone,     // the search could not leave its start
};

/// Moves the window to the vehicle and sets the count of expansions to zero.
void begin_searches(SearchState& state, const SearchContext& context, const Vec3& start_enu_m);

/// A* in the flight surface, from `from` to the nearest place that is good for seeing the target.
/// Good means:
/// - the horizontal distance to the target is the wanted one, within the tolerance;
/// - the line of sight to the target is free;
/// - everybody who is expected nearby at time_s (absolute) is at least the check's gap away.
/// Way within the wanted gap costs more. Appends the places after `from` to `path`; nothing if
/// `from` is good already. A start nearer to obstacles than allowed may be left in directions that
/// do not come nearer. Cost: bounded by expansions_max; in open space a few expansions a cell of
/// way.
WaypointKind search_waypoint(SearchState& state, const SearchContext& context, const Vec3& from,
                             const Vec3& target_enu_m, double time_s, int expansions_max,
                             std::vector<Vec3>& path);

}  // namespace foretrack
