// SPDX-License-Identifier: Apache-2.0
// Where the flight controller returns to, and how its local frame lies on the Earth.
#pragma once

#include <optional>

#include "core/common/geometry.hpp"
#include "px4_msgs/msg/HomePosition.h"
#include "px4_msgs/msg/VehicleCommand.h"
#include "px4_msgs/msg/VehicleLocalPosition.h"
#include "services/convert/checks.hpp"

namespace foretrack {

/// WGS84, degrees; altitude over mean sea level.
struct GlobalPlace {
  double lat_deg = 0.0, lon_deg = 0.0, alt_m = 0.0;
};

/// Of the world frame's origin, by the projection that PX4's local frame is made with: azimuthal,
/// equidistant, on a sphere.
GlobalPlace global_of(const GlobalPlace& origin, const Vec3& place_enu_m);
Vec3 local_of(const GlobalPlace& origin, const GlobalPlace& place);

/// Where the local frame's origin is; none: the flight controller knows no global position.
std::optional<GlobalPlace> origin_of(const px4_msgs::msg::VehicleLocalPosition& in);
void set_origin(const GlobalPlace& origin, px4_msgs::msg::VehicleLocalPosition& out);

/// World ENU. A fault: the flight controller has no home in its local frame.
Converted<Vec3> from_idl(const px4_msgs::msg::HomePosition& in);
void to_idl(const GlobalPlace& origin, const Vec3& home_enu_m, double stamp_s,
            px4_msgs::msg::HomePosition& out);

/// Asks for another home (MAV_CMD_DO_SET_HOME), as an onboard computer of the vehicle.
void to_set_home(const GlobalPlace& place, int system_id, double stamp_s,
                 px4_msgs::msg::VehicleCommand& out);
/// The place that is asked for; none: another command, or no place on the Earth.
std::optional<GlobalPlace> home_asked_by(const px4_msgs::msg::VehicleCommand& in);

}  // namespace foretrack
