// SPDX-License-Identifier: Apache-2.0
// Everybody who moves, as one plan sees them.
#pragma once

#include "core/planning/plan_input.hpp"
#include "core/planning/see/target_belief.hpp"

namespace foretrack {

/// The bodies of the input, and the followed person on each path of the belief that is likely
/// enough: the likeliest over the whole horizon, the others over the short one. If the followed
/// person is among the bodies, radius and height are taken from there; else from the parameters,
/// with the foot on the ground below the believed torso. A body whose place is uncertain is as much
/// wider. Bodies that cannot come near within the horizon are left out. No belief (null): the
/// followed person is where the bodies of the input have them. A followed person who is not seen,
/// below a vehicle that is above their head, counts as anywhere within a walk besides. Cost: a few
/// microseconds a body.
void expect_bodies(const PlanInput& input, const TargetBelief* belief, const GapParams& params,
                   BodyCourses& courses);

}  // namespace foretrack
