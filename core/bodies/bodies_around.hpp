// SPDX-License-Identifier: Apache-2.0
// Tracks and the followed person → all moving bodies at one moment.
#pragma once

#include "core/bodies/track_bodies.hpp"
#include "core/common/prediction.hpp"

namespace foretrack {

/// The person who is followed, as other stages know them.
struct Followed {
  const TargetState& target;
  const Prediction* prediction = nullptr;  ///< null: constant velocity
  double height_m = 1.75;
};

/// All believed bodies at now_s ≥ the newest frame: others go on with constant velocity, less and
/// less certain; the followed person first, while they are tracked or coasting, with the places of
/// the most probable path; then the nearest to `near_enu_m`. `looks`, unless empty, has room for
/// MovingBodies::kCapacity, and gets what images show of each. Cost: some microseconds.
void bodies_around(BodiesState& state, double now_s, const Followed& followed,
                   const Vec3& near_enu_m, const BodyParams& params, MovingBodies& out,
                   std::span<PersonLook> looks = {});

/// The followed person as a body at now_s. Precondition: the target is usable.
MovingBody followed_body(const Followed& followed, double now_s, const BodyParams& params);

}  // namespace foretrack
