// SPDX-License-Identifier: Apache-2.0
// An angle that follows a bearing within rate and acceleration limits: yaw, and a gimbal's pitch.
#pragma once

#include <vector>

#include "core/common/trajectory.hpp"

namespace foretrack {

/// How fast an angle may change.
struct AngleLimits {
  double rate_max_rad_s = 2.0;
  double acceleration_max_rad_s2 = 6.0;
  double tolerance_rad = 0.5;  // errors beyond it (out of view) weigh much more
  double effort = 0.002;       // weight of squared acceleration against squared error
};

/// Owned by the caller and reused.
struct AnglePlanWorkspace {
  /// One step of the dynamic programme.
  struct Stage {
    double wanted_rad, weight;
    double gain_angle, gain_rate, feedforward;  // acceleration = feedforward − gains · state
    bool clamped;
    double acceleration;
  };
  std::vector<Stage> stages;
};

/// Fills `plan` with constant accelerations between nodes, from `start` on: the least sum of
/// squared errors against wanted_rad[i] at node i + 1 (any turn of the circle: the nearest one to
/// the one before is meant) and of effort, subject to the limits, which hold exactly. Solved by a
/// Riccati recursion that is repeated a few times with the accelerations at their bounds held
/// there. After the last wanted angle the rate is braked to zero. A start rate beyond its limit is
/// braked at once. Cost: about 0.05 µs a node and pass.
void plan_angle(const AngleNode& start, const std::vector<double>& wanted_rad,
                const AngleLimits& limits, AnglePlanWorkspace& workspace, AnglePlan& plan);

}  // namespace foretrack
