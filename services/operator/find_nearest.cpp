// SPDX-License-Identifier: Apache-2.0
#include "services/operator/find_nearest.hpp"

#include "core/common/moving_body.hpp"
#include "services/convert/bodies.hpp"
#include "services/convert/vehicle.hpp"

namespace foretrack {

void FindNearest::update() {
  odometry_.take_each_as(
      [](const auto& message) { return from_idl(message); },
      [this](const VehicleState& state) { vehicle_enu_m_ = state.position_enu_m; });
  bodies_.take_each_as([](const auto& message) { return from_idl(message); },
                       [this](const MovingBodies& bodies) {
                         if (!vehicle_enu_m_) return;
                         const MovingBody* nearest = nearest_person(bodies, *vehicle_enu_m_);
                         if (nearest) person_id_ = nearest->id;
                       });
}

}  // namespace foretrack
