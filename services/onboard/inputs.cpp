// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/inputs.hpp"

#include <limits>

namespace foretrack {

VehicleInput::VehicleInput(Service& service, std::function<void()> changed)
    : reader_(service.node()) {
  service.loop().on_each(
      reader_, [](const nav_msgs::msg::Odometry& message) { return from_idl(message); },
      [this, &service, changed = std::move(changed)](const VehicleState& state) {
        add(state);
        last_ = state;
        arrived_s_ = service.clock().steady_s();
        if (changed) changed();
      });
}

void VehicleInput::add(const VehicleState& state) {
  if (newest() && state.stamp_s < newest()->stamp_s - kRestart_s) history_ = VehicleHistory();
  history_.add(state);
}

double VehicleInput::age_s(double now_s) const {
  return newest() ? now_s - newest()->stamp_s : std::numeric_limits<double>::infinity();
}

}  // namespace foretrack
