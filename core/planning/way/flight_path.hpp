// SPDX-License-Identifier: Apache-2.0
// From waypoints to the few segments of a corridor, with times.
#pragma once

#include <vector>

#include "core/planning/way/waypoint_search.hpp"

namespace foretrack {

/// The searched way, and where on it the waypoints are: arrival[k] is the index of the place at
/// t_k.
struct WaypointPath {
  std::vector<Vec3> points;  // first the start
  std::vector<int> arrival;  // one for each t_k
};

/// A polyline that keeps the clearance, its vertices at these times after the start.
struct FlightPath {
  std::vector<Vec3> vertices;  // one more than segments
  std::vector<double> times_s;
};

/// Workspace of make_flight_path.
struct FlightPathWorkspace {
  std::vector<double> arc_m;       // of the points
  std::vector<double> schedule_m;  // arc at t_k that the vehicle can reach
};

/// Straightens the way into at most polytopes_max segments of at most about segment_max_m, and
/// times the vertices: at t_k the vehicle is at waypoint k if it can be there, starting with
/// start_speed_m_s. Times increase by at least min_segment_s and end at the horizon or later. The
/// way is cut where the vehicle cannot be until well after the horizon.
void make_flight_path(const SearchContext& context, const WaypointPath& way, double start_speed_m_s,
                      FlightPathWorkspace& workspace, FlightPath& path);

/// Where on the way the vehicle can be at t_k, k = 1 …; after make_flight_path.
Vec3 scheduled_position(const WaypointPath& way, const FlightPathWorkspace& workspace,
                        std::size_t k);

}  // namespace foretrack
