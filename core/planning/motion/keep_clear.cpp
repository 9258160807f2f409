// SPDX-License-Identifier: Apache-2.0
#include "core/planning/motion/keep_clear.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/planning/motion/stop_tail.hpp"

namespace foretrack {
namespace {

constexpr double kGapStep_s = 0.05;
constexpr double kMoves_m_s = 0.05;
constexpr double kFar_m = std::numeric_limits<double>::infinity();
constexpr double kLeastWeight = 5.0;  // of what is missing of the least gap, in metres
constexpr double kReachWeight = 4.0;  // of a gap that bodies can close, against an expected one

double cubed(double x) {
  return x <= 0.0 ? 0.0 : x * x * x;
}

// The least gap that bodies can make, and what is missing of it, along one motion.
struct Closing {
  double least_m = kFar_m;
  double cost = 0.0;
};

bool is_beyond(const Vec3& p, const Vec3& axis, double distance_m) {
  return (p - axis).head<2>().squaredNorm() > distance_m * distance_m;
}

// Bodies that are too far off to change the result are skipped before anything is computed.
struct Measuring {
  const BodyCourses& courses;
  const GapParams& params;
  BodyGaps gaps;

  void expect(const Vec3& p, double time_s, double after_s) {
    for (const BodyCourse& course : courses.all()) {
      if (after_s > course.horizon_s) continue;
      const MovingBody& body = course.body;
      const Vec3 foot = body.expected_at(time_s);
      const double counts_m = std::max(gaps.least_m, params.gap_wanted_m);
      if (is_beyond(p, foot, counts_m + params.hull_radius_m + body.radius_m)) continue;
      const double gap_m =
          foretrack::gap_m(p, params.hull_radius_m, foot, body.radius_m, body.height_m);
      if (gap_m < gaps.least_m) gaps.least_m = gap_m, gaps.least_at_s = after_s;
      gaps.cost += kGapStep_s * cubed(params.gap_wanted_m - gap_m);
    }
  }
  // Nobody gets farther from where they are now.
  double reach_m(const MovingBody& body, double time_s) const {
    const double speed_m_s = std::max(params.body_speed_m_s, body.velocity_enu_m_s.norm());
    return body.radius_m + speed_m_s * std::max(time_s - body.stamp_s, 0.0);
  }
  void reach(const Vec3& p, double time_s, Closing& closing) const {
    for (const BodyCourse& course : courses.all()) {
      const MovingBody& body = course.body;
      const double counts_m = std::max(closing.least_m, params.reach_gap_m);
      if (is_beyond(p, body.position_enu_m,
                    counts_m + params.hull_radius_m + reach_m(body, time_s)))
        continue;
      const double gap_m = least_gap_m(p, params.hull_radius_m, body, time_s, params.bounds());
      closing.least_m = std::min(closing.least_m, gap_m);
      closing.cost += kReachWeight * kGapStep_s * cubed(params.reach_gap_m - gap_m);
    }
  }
  // Whoever is ahead of a person goes on, whoever is behind stops: the better one counts.
  void reach_both(const PlannedTrajectory& trajectory, double begin_s, const QuinticPiece& stop) {
    Closing stopping, going_on;
    const double end_s = stop.duration_s + params.retreat_s;
    for (double after_s = 0.0; after_s <= end_s; after_s += kGapStep_s) {
      const double t_s = begin_s + after_s, time_s = trajectory.start_s + t_s;
      reach(stop.position(std::min(after_s, stop.duration_s)), time_s, stopping);
      reach(trajectory.position(t_s), time_s, going_on);
    }
    const Closing& better = stopping.least_m >= going_on.least_m ? stopping : going_on;
    gaps.reach_m = better.least_m;
    gaps.cost += better.cost;
  }
};

double longest_horizon_s(const BodyCourses& courses) {
  double longest_s = 0.0;
  for (const BodyCourse& course : courses.all()) longest_s = std::max(longest_s, course.horizon_s);
  return longest_s;
}

}  // namespace

void BodyCourses::add(const BodyCourse& course) {
  if (count < kCapacity) courses[count++] = course;
}

BodyGaps measure_gaps(const PlannedTrajectory& trajectory, double t_s, const BodyCourses& courses,
                      const FlightLimits& limits, const GapParams& params) {
  Measuring m{courses, params, {kFar_m, 0.0, kFar_m, 0.0, true}};
  if (courses.count == 0) return m.gaps;
  const double horizon_s = longest_horizon_s(courses);
  for (double after_s = 0.0; after_s <= horizon_s; after_s += kGapStep_s)
    m.expect(trajectory.position(t_s + after_s), trajectory.start_s + t_s + after_s, after_s);

  const double begin_s = t_s + params.reaction_s;
  const BoundaryState moving{trajectory.position(begin_s), trajectory.velocity(begin_s),
                             trajectory.acceleration(begin_s)};
  if (moving.velocity.norm() > kMoves_m_s)
    m.reach_both(trajectory, begin_s, make_stop_tail(moving, limits).piece);
  // Passing through somebody quickly is not better than being near for longer.
  m.gaps.cost += kLeastWeight * std::max(params.gap_min_m - m.gaps.least_m, 0.0);
  m.gaps.ok = m.gaps.least_m >= params.gap_min_m && m.gaps.reach_m >= params.reach_gap_m;
  return m.gaps;
}

ParamRows rows(GapParams& p) {
  return {
      {"hull_radius_m", &p.hull_radius_m, "m", 0.05, 2.0,
       "of the ball around the vehicle, by which gaps to people and vehicles are measured"},
      {"gap_min_m", &p.gap_min_m, "m", 0.0, 5.0,
       "a trajectory that comes nearer to somebody's expected places fails the check"},
      {"gap_wanted_m", &p.gap_wanted_m, "m", 0.0, 5.0,
       "search and optimiser keep so far from expected places where they can"},
      {"unseen_gap_m", &p.unseen_gap_m, "m", 0.0, 2.0,
       "where no way out through seen space keeps so far from somebody's expected places, one "
       "through unseen space is tried"},
      {"reach_gap_m", &p.reach_gap_m, "m", 0.0, 2.0,
       "kept while the vehicle stops, however bodies turn, stop or start"},
      {"body_horizon_s", &p.body_horizon_s, "s", 0.2, 6.0,
       "expected places of bodies count so far ahead"},
      {"unlikely_horizon_s", &p.unlikely_horizon_s, "s", 0.0, 6.0,
       "the same, of courses that are not the likeliest"},
      {"course_probability_min", &p.course_probability_min, "", 0.0, 1.0,
       "less likely courses of the followed person do not count"},
      {"reaction_s", &p.reaction_s, "s", 0.0, 1.0, "until the vehicle can begin to stop"},
      {"retreat_s", &p.retreat_s, "s", 0.0, 2.0, "until it has left the place of its stop"},
      {"body_speed_m_s", &p.body_speed_m_s, "m/s", 0.0, 20.0,
       "anybody may move so fast at any moment, or as fast as seen"},
      {"body_acceleration_m_s2", &p.body_acceleration_m_s2, "m/s2", 0.0, 20.0,
       "anybody may change their velocity so fast"},
      {"person_height_m", &p.person_height_m, "m", 0.3, 2.5, "of the followed person"},
      {"person_radius_m", &p.person_radius_m, "m", 0.05, 1.0, "of the followed person"},
      {"least_altitude_m", &p.least_altitude_m, "m", 0.0, 10.0,
       "the vehicle stays so high above the ground below it"},
  };
}

}  // namespace foretrack
