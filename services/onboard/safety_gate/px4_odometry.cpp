// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/safety_gate/px4_odometry.hpp"

#include "services/convert/px4.hpp"
#include "services/convert/transforms.hpp"
#include "services/convert/vehicle.hpp"

namespace foretrack {

Px4Odometry::Px4Odometry(Service& service)
    : reader_(service.node()), odometry_(service.node()), transforms_(service.node()) {
  service.loop().on_each(
      reader_, [](const px4_msgs::msg::VehicleOdometry& message) { return from_idl(message); },
      [this, body = service.options().names.frame(kBodyFrame)](const VehicleState& state) {
        to_idl(state, odometry_.sample(), body);
        odometry_.write();
        if (transforms_.readers() == 0) return;
        to_transform(state, body, transforms_.sample());
        transforms_.write();
      });
}

}  // namespace foretrack
