// SPDX-License-Identifier: Apache-2.0
// Where bodies were seen once: what detectors say, before anything is tracked.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/common/moving_body.hpp"

namespace foretrack {

/// One body in one frame. World ENU, SI.
struct BodySighting {
  BodyKind kind = BodyKind::kUnknown;  ///< kUnknown: something that moves
  Vec3 position_enu_m = Vec3::Zero();  ///< the middle of its lowest face, as in MovingBody
  Mat2 covariance_m2 = Mat2::Zero();   ///< horizontal
  double radius_m = 0.25;
  double height_m = 1.75;
};

/// All bodies of one frame of one detector, without the followed person where it can tell.
struct BodySightings {
  static constexpr int kCapacity = MovingBodies::kCapacity;

  double stamp_s = 0.0;  ///< of the frame
  int count = 0;
  std::array<BodySighting, kCapacity> bodies{};

  std::span<const BodySighting> all() const {
    return {bodies.data(), static_cast<std::size_t>(count)};
  }
  /// False, and nothing is added, when there is no room.
  bool add(const BodySighting& body) {
    if (count >= kCapacity) return false;
    bodies[count++] = body;
    return true;
  }
};

}  // namespace foretrack
