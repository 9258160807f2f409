// SPDX-License-Identifier: Apache-2.0
// How far the vehicle keeps from everybody who moves: parameters, the courses that are kept clear
// of, and the measure by which check, fall-back and evasion compare trajectories.
#pragma once

#include <array>

#include "core/common/moving_body.hpp"
#include "core/planning/motion/flight_limits.hpp"

namespace foretrack {

/// A gap is the distance in space between the vehicle's ball and a body's upright cylinder.
struct GapParams {
  /// of the ball around the vehicle, by which gaps to people and vehicles are measured
  double hull_radius_m = 0.25;
  /// a trajectory that comes nearer to somebody's expected places fails the check
  double gap_min_m = 0.5;
  /// search and optimiser keep so far from expected places where they can
  double gap_wanted_m = 0.8;
  /// where no way out through seen space keeps so far from somebody's expected places, one through
  /// unseen space is tried
  double unseen_gap_m = 0.3;
  double reach_gap_m = 0.1;  ///< kept while the vehicle stops, however bodies turn, stop or start
  double body_horizon_s = 3.0;          ///< expected places of bodies count so far ahead
  double unlikely_horizon_s = 0.0;      ///< the same, of courses that are not the likeliest
  double course_probability_min = 0.1;  ///< less likely courses of the followed person do not count
  double reaction_s = 0.1;              ///< until the vehicle can begin to stop
  double retreat_s = 0.0;               ///< until it has left the place of its stop
  double body_speed_m_s = 2.0;  ///< anybody may move so fast at any moment, or as fast as seen
  double body_acceleration_m_s2 = 3.0;  ///< anybody may change their velocity so fast
  double person_height_m = 1.75;        ///< of the followed person
  double person_radius_m = 0.25;        ///< of the followed person
  double least_altitude_m = 1.0;        ///< the vehicle stays so high above the ground below it

  BodyMotionBounds bounds() const { return {body_speed_m_s, body_acceleration_m_s2}; }
};
/// One row for each field: name, unit, range, meaning.
ParamRows rows(GapParams& params);

/// One course that one body may take.
struct BodyCourse {
  MovingBody body;
  double probability = 1.0;  // of this course among those of the same body
  double horizon_s = 0.0;    // counts so far ahead
};

/// All courses that count in one plan, with room for several of the followed person.
struct BodyCourses {
  static constexpr int kCapacity = MovingBodies::kCapacity + 8;

  int count = 0;
  std::array<BodyCourse, kCapacity> courses;

  std::span<const BodyCourse> all() const {
    return {courses.data(), static_cast<std::size_t>(count)};
  }
  /// Without effect when there is no room.
  void add(const BodyCourse& course);
};

/// How near a trajectory comes to bodies.
struct BodyGaps {
  double least_m = 0.0;     // to expected places; infinite without bodies
  double least_at_s = 0.0;  // after the point from which it is measured
  double reach_m = 0.0;     // least gap that is possible while it stops, whatever bodies do
  double cost =
      0.0;  // ∫ (what is missing of the wanted gaps)³ dt + 5 · what is missing of gap_min_m
  bool ok = true;  // the check's gaps are kept
};

/// Measures a trajectory from t_s on; absolute time is trajectory.start_s + t. The expected gap
/// counts over each course's horizon.
/// The reach says whether each body's reachable disc is kept clear of what the vehicle cannot leave
/// in time. Two ways are measured, and the one that keeps clearer counts: a stop that begins
/// reaction_s after t_s and lasts until the vehicle can have left its place (retreat_s), and to go
/// on for as long.
/// Cost: about 0.3 µs a course and 0.1 s.
BodyGaps measure_gaps(const PlannedTrajectory& trajectory, double t_s, const BodyCourses& courses,
                      const FlightLimits& limits, const GapParams& params);

}  // namespace foretrack
