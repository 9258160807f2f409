// SPDX-License-Identifier: Apache-2.0
// Moving bodies and the sightings they are tracked by.
#pragma once

#include <span>

#include "core/common/body_sighting.hpp"
#include "core/common/person_look.hpp"
#include "foretrack_msgs/msg/BodySightings.h"
#include "foretrack_msgs/msg/MovingBodies.h"
#include "services/convert/checks.hpp"

namespace foretrack {

/// `looks`: what images show of each body, or empty.
void to_idl(const MovingBodies& bodies, std::span<const PersonLook> looks,
            foretrack_msgs::msg::MovingBodies& out);
/// Without the looks, which are for people and not read on board. At most one is followed.
Converted<MovingBodies> from_idl(const foretrack_msgs::msg::MovingBodies& in);

void to_idl(const BodySightings& sightings, foretrack_msgs::msg::BodySightings& out);
Converted<BodySightings> from_idl(const foretrack_msgs::msg::BodySightings& in);

}  // namespace foretrack
