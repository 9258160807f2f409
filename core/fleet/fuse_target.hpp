// SPDX-License-Identifier: Apache-2.0
// One estimate of the person from several vehicles', of which nobody knows how they hang together.
#pragma once

#include <span>

#include "core/common/target.hpp"
#include "core/fleet/fleet_member.hpp"

namespace foretrack {

/// The person's state at a later time, with constant velocity and white acceleration.
FleetPerson at_time(FleetPerson person, double from_s, double to_s);

/// Squared Mahalanobis distance of two estimates' places on the ground.
double apart2(const FleetPerson& a, const FleetPerson& b);

/// Covariance intersection (Julier and Uhlmann 1997): consistent whatever the correlation. The
/// weight is the one of least determinant, to one part in 32. Position and velocity as in a.
FleetPerson intersect(const FleetPerson& a, const FleetPerson& b);

}  // namespace foretrack
