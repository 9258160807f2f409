// SPDX-License-Identifier: Apache-2.0
// The gate's own check of every plan that comes, and of what is flown. It knows no plan's maker.
#pragma once

#include "core/safety/check_motion.hpp"
#include "core/safety/mission.hpp"
#include "core/safety/surroundings.hpp"

namespace foretrack {

/// What every plan must keep, whoever made it.
struct PlanCheckParams {
  MotionLimits limits;
  Clearances clearances;
  double oldest_start_s = 0.5;    // a plan that began longer ago is refused
  double farthest_start_s = 1.0;  // or that begins farther ahead
  double body_horizon_s = 2.0;  // so far ahead, bodies are expected to be where they are said to be
  double braking_m_s2 = 3.0;    // that the vehicle can count on
  double look_ahead_s = 1.5;    // what is flown is looked at so far ahead
  bool needs_map = true;
  JointTolerance flown{0.1, 0.3, 1.5, 0.2};     // to what is flown
  JointTolerance measured{0.4, 0.8, 1e9, 0.5};  // to the vehicle itself
};

/// What is flown now, and what is around.
struct Situation {
  Moment moment;
  const PlannedTrajectory* flown = nullptr;  // its start on the monotonic clock; null: none is
  Joint vehicle;                             // as measured, carried on to now
  std::uint64_t last_id = 0;                 // of the plans of late; 0: there were none
  double last_start_s = -1e18;               // of the last one, monotonic
  GateSurroundings around;
  const DeviationBound* deviation = nullptr;  // of the vehicle from its plans; null: not measured
};

/// Judges a plan that has pieces. start_s and stamp_s are on the clock of stamps.
/// Too near an obstacle for what the vehicle leaves such plans by, to somebody, to a bound or to
/// the ground: unless it comes from there and goes away. Of bodies, a plan nearer than the floor is
/// good enough if neither what is flown nor a stop is farther away from it. Into space that nobody
/// has seen it may lead where all these come nearer to somebody than the floor, and it does not.
/// Bounded cost.
PlanFault check_plan(const PlannedTrajectory& plan, const Situation& now,
                     const PlanCheckParams& params);

/// The same of what is flown, from now on, as far as the vehicle needs to stop: kObstacle, kBody,
/// kBounds or kNone. A body is no reason where a stop would be no farther from it.
PlanFault check_flown(const Situation& now, const PlanCheckParams& params);

}  // namespace foretrack
