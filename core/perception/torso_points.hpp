// SPDX-License-Identifier: Apache-2.0
// Points on the torso in an image, to sample what is there.
#pragma once

#include <array>

#include "core/common/target.hpp"

namespace foretrack {

/// Calls visit(image_px, row) at the middle of each of steps × steps parts of the torso. Rows go
/// from the shoulders (0) to the hips, columns from the person's left to their right. `margin`: the
/// share of the torso that is left out at each of its four sides.
template <class Visit>
void visit_torso(const std::array<Landmark, kLandmarkCount>& landmarks, int steps, double margin,
                 Visit visit) {
  const auto corner = [&](TorsoJoint joint) { return landmarks[joint].image_px; };
  const auto share = [&](int k) { return margin + (1.0 - 2.0 * margin) * (k + 0.5) / steps; };
  for (int row = 0; row < steps; ++row) {
    const double down = share(row);
    const Vec2 left = (1.0 - down) * corner(kLeftShoulder) + down * corner(kLeftHip);
    const Vec2 right = (1.0 - down) * corner(kRightShoulder) + down * corner(kRightHip);
    for (int column = 0; column < steps; ++column) {
      const double across = share(column);
      visit(Vec2((1.0 - across) * left + across * right), row);
    }
  }
}

}  // namespace foretrack
