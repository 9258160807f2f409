// SPDX-License-Identifier: Apache-2.0
// The person who is followed: walks, stops suddenly, turns the shoulders before the path turns.
#pragma once

#include <vector>

#include "core/simulator/body.hpp"
#include "core/simulator/walk.hpp"

namespace foretrack {

/// The person stops at at_s and stands for for_s. A stop that falls into a corner begins after it.
struct StandStill {
  double at_s = 0.0;  ///< on the clock of PersonState
  double for_s = 1.0;
};

/// The person walks backwards in this time of the walk: the chest points where they come from.
struct BackwardSteps {
  double from_s = 0.0;
  double to_s = 0.0;
};

/// How a person moves along a walk.
struct PersonParams {
  double height_m = 1.75;
  double acceleration_m_s2 = 3.0;    ///< of stops and starts
  double shoulder_lead_s = 0.3;      ///< the chest points where the walk will be heading by then;
                                     ///< negative: where it was heading so long ago
  double shoulder_offset_rad = 0.0;  ///< and aside from there; π: they walk backwards
  double shoulder_sway_rad = 0.0;    ///< to and fro about that, while they walk
  double shoulder_sway_hz = 0.5;
  double yaw_rate_rad_s = 5.0;  ///< greatest with which the chest follows the course
  double start_s = 1.5;         ///< the person stands until then
  std::vector<StandStill> stops;
  std::vector<BackwardSteps> backward;
};

/// A person on their walk.
struct Person {
  PersonParams params;
  Walk walk;
  PersonState state;
  double walked_s = 0.0;    ///< time along the walk
  double pace = 1.0;        ///< d walked_s / dt: below 1 while stopping and standing
  double course_rad = 0.0;  ///< where a chest without offset and sway would point
};

/// A person at the start of the walk. ground_z_m: where the feet are.
Person make_person(const PersonParams& params, Walk walk, double ground_z_m);

/// Moves the person on to state.stamp_s + dt_s. Cost: logarithmic in the walk's pieces.
void advance(Person& person, double dt_s);

}  // namespace foretrack
