// SPDX-License-Identifier: Apache-2.0
// From where the person is to be seen, as an operator wants it: taken on slowly, and never nearer
// than is safe.
#pragma once

#include <algorithm>

#include "core/planning/plan_input.hpp"

namespace foretrack {

/// The direction of the vehicle from the person, in the world's plane, and where it goes.
struct WantedBearing {
  double at_s = 0.0;            ///< of now_rad
  double now_rad = 0.0;         ///< ENU
  double offset_rad = 0.0;      ///< from there to what is wanted
  double circling_rad_s = 0.0;  ///< by which what is wanted goes round
  double rate_rad_s = 0.0;      ///< at most, of the bearing itself

  /// At an absolute time from at_s on.
  double at(double time_s) const {
    const double t_s = std::max(time_s - at_s, 0.0), most_rad = rate_rad_s * t_s;
    return now_rad + std::clamp(offset_rad + circling_rad_s * t_s, -most_rad, most_rad);
  }
};

/// Kept from replan to replan.
struct FramingState {
  bool active = false;  ///< something is wanted, or what was is not yet given up
  double at_s = 0.0;    ///< of the last replan
  double distance_m = 0.0, height_m = 0.0;  ///< as they are kept now
  double course_rad = Framing::kFree;       ///< where the person walked last, ENU
  double gone_round_rad = 0.0;              ///< since the circling began
  bool turns = false;                       ///< a bearing is kept
  WantedBearing bearing;                    ///< valid if so
  PlanningParams params;                    ///< those that were given, with distance and height
};

/// The parameters to plan with: those that are given, unless something is wanted. Distance, height
/// and bearing move on from where they are by what a person and the optimiser can follow; what is
/// not wanted any more goes back to the parameters. The distance is never less than the parameters'
/// least one, the height none from which the camera would look too steeply. A bearing stays where
/// the vehicle cannot follow it. The result is valid until the next call.
const PlanningParams& frame_target(FramingState& state, const PlanInput& input,
                                   const PlanningParams& params);

}  // namespace foretrack
