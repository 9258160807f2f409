// SPDX-License-Identifier: Apache-2.0
// What the vehicle must keep clear of: obstacles, bodies, and the bounds of where it may fly.
#pragma once

#include "core/common/deviation_bound.hpp"
#include "core/common/grid_map.hpp"
#include "core/common/moving_body.hpp"
#include "core/common/trajectory.hpp"
#include "core/safety/flight_bounds.hpp"

namespace foretrack {

/// World ENU. Null: not known.
struct GateSurroundings {
  const GridMap* map = nullptr;
  const MovingBodies* bodies = nullptr;
  FlightBounds bounds = {};
  double ground_m = 0.0;  // where the map does not know it
};

/// The place with its height over the ground below, which may slope or have steps: as the map knows
/// it, else over ground_m.
Vec3 over_ground(const GateSurroundings& around, const Vec3& place_enu_m);

/// How much room there must be.
struct Clearances {
  double vehicle_radius_m = 0.25;  // of its hull, a ball
  double obstacle_m = 0.30;        // from its centre to what is occupied or unknown, at least
  double obstacle_most_m = 0.35;   // the same, of a vehicle that leaves its plans by much
  double body_m = 0.3;             // from hull to hull
  double bounds_m = 0.5;           // from its centre to fence and altitudes
  double least_altitude_m = 0.8;   // of a plan, over the ground
};

/// The room that a plan must have at a speed: the hull and what the vehicle leaves such plans by,
/// within bounds.
struct ObstacleRoom {
  double hull_m = 0.25;
  double least_m = 0.30, most_m = 0.45;
  const DeviationBound* deviation = nullptr;  // as measured; null: the least

  double at_m(double speed_m_s, double acceleration_m_s2) const;
};

/// How far inside of the bounds a place over the ground is; negative outside; infinite without any.
/// Cost: the fence's corners.
double room_m(const FlightBounds& bounds, const Vec3& place_over_ground_m);

/// Where the vehicle may be at a time: a plan, a stop, or a place.
class Course {
 public:
  /// A plan from t = from_s on. The plan must outlive it.
  Course(const PlannedTrajectory& plan, double from_s);
  /// A stop from that motion on, straight ahead.
  Course(const Vec3& position_enu_m, const Vec3& velocity_enu_m_s, double braking_m_s2);

  /// t after the course's begin.
  Vec3 position(double t_s) const;
  double speed(double t_s) const;
  double acceleration(double t_s) const;
  double duration_s() const { return duration_s_; }

 private:
  const PlannedTrajectory* plan_ = nullptr;
  double from_s_ = 0.0, duration_s_ = 0.0;
  Vec3 position_enu_m_ = Vec3::Zero(), velocity_enu_m_s_ = Vec3::Zero();
  double braking_m_s2_ = 0.0;
};

/// The first time at which it leads too near what is not passable or out of the map; −1: never in
/// its first `until_s`. Looked at so closely that it moves no further than a quarter of a
/// cell between two looks, or than its clearance. A begin that is too near, or too fast for what is
/// near, is left within a metre, no nearer.
double time_at_obstacle(const Course& course, const GridMap& map, const ObstacleRoom& room,
                        double acceleration_m_s2, double until_s,
                        Passable passable = Passable::kSeenFree);

/// The same of the bounds: a begin outside of them is left, no farther outside.
double time_out_of_bounds(const Course& course, const GateSurroundings& around, double bounds_m,
                          double until_s);

/// The same of the least altitude over the ground: from a begin below it, the course leads no
/// lower.
double time_too_low(const Course& course, const GateSurroundings& around, double least_altitude_m,
                    double until_s);

/// The least expected gap to the body in the course's first `until_s`, which begin at begin_s (as
/// the body's stamps have it). Looked at every 20 ms at least.
double least_expected_gap_m(const Course& course, const MovingBody& body, double vehicle_radius_m,
                            double begin_s, double until_s);

}  // namespace foretrack
