// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/inputs.hpp"

#include <limits>

namespace foretrack {

VehicleInput::VehicleInput(Service& service, std::function<void()> changed)
    : service_(service), reader_(service.node()) {
  service.loop().on_each(
      reader_,
      [frames = frames()](const nav_msgs::msg::Odometry& message) {
        return from_idl(message, frames);
      },
      [this, &service, changed = std::move(changed)](const VehicleState& state) {
        add(state);
        last_ = state;
        arrived_s_ = service.clock().steady_s();
        if (changed) changed();
      });
}

OdometryFrames VehicleInput::frames() {
  const Names& names = service_.options().names;
  const auto in_map = [this](const std::string& frame, double stamp_s, std::string& why) {
    if (!transforms_) {
      transforms_ = std::make_unique<TransformInput>(service_);
      service_.node().announce();
    }
    transforms_->update();
    return transforms_->in_map(frame, stamp_s, why);
  };
  return {names.body_frame, names.odometry_is_map, in_map};
}

void VehicleInput::add(const VehicleState& state) {
  if (newest() && state.stamp_s < newest()->stamp_s - kRestart_s) history_ = VehicleHistory();
  history_.add(state);
}

double VehicleInput::age_s(double now_s) const {
  return newest() ? now_s - newest()->stamp_s : std::numeric_limits<double>::infinity();
}

}  // namespace foretrack
