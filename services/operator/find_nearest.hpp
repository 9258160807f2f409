// SPDX-License-Identifier: Apache-2.0
// The number of the person who is nearest to the vehicle.
#pragma once

#include <cstdint>
#include <optional>

#include "core/common/geometry.hpp"
#include "foretrack_msgs/msg/MovingBodies.h"
#include "nav_msgs/msg/Odometry.h"
#include "services/common/reader.hpp"
#include "services/common/topics.hpp"

namespace foretrack {

/// By `bodies` and `odometry` in the map's frame.
class FindNearest {
 public:
  explicit FindNearest(Node& node) : bodies_(node), odometry_(node) {}

  /// Call it about twenty times a second.
  void update();
  /// None: nobody is known yet, or where the vehicle is.
  std::optional<std::uint32_t> person_id() const { return person_id_; }

 private:
  Reader<topics::MovingBodies> bodies_;
  Reader<topics::Odometry> odometry_;
  std::optional<Vec3> vehicle_enu_m_;
  std::optional<std::uint32_t> person_id_;
};

}  // namespace foretrack
