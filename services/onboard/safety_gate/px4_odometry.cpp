// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/safety_gate/px4_odometry.hpp"

#include <spdlog/spdlog.h>

#include "services/convert/px4.hpp"
#include "services/convert/transforms.hpp"
#include "services/convert/vehicle.hpp"

namespace foretrack {

Px4Odometry::Px4Odometry(Service& service)
    : reader_(service.node()), odometry_(service.node()), transforms_(service.node()) {
  service.loop().on_each(
      reader_,
      [this](const px4_msgs::msg::VehicleOdometry& message) {
        notice_reset(message.reset_counter());
        return from_idl(message);
      },
      [this, body = service.options().names.frame(kBodyFrame)](const VehicleState& state) {
        to_idl(state, odometry_.sample(), body);
        odometry_.write();
        if (transforms_.readers() == 0) return;
        to_transform(state, body, transforms_.sample());
        transforms_.write();
      });
}

// The map stays where it was: the gate brakes where the jump is a large one.
void Px4Odometry::notice_reset(int counter) {
  if (resets_ >= 0 && counter != resets_)
    spdlog::warn("safety_gate: the flight controller has set its estimate anew ({} times so far)",
                 counter);
  resets_ = counter;
}

}  // namespace foretrack
