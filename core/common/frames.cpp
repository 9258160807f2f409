// SPDX-License-Identifier: Apache-2.0
#include "core/common/frames.hpp"

namespace foretrack {

Quat swap_attitude_enu_ned(const Quat& q) {
  // R_ned_frd = S · R_enu_flu · D, S swaps x and y and flips z, D flips y and z; both are their own
  // inverse.
  const Quat world_swap(0.0, std::sqrt(0.5), std::sqrt(0.5), 0.0);
  const Quat body_flip(0.0, 1.0, 0.0, 0.0);
  return (world_swap * q * body_flip).normalized();
}

Mat3 flu_from_optical() {
  Mat3 r;
  r << 0, 0, 1,  //
      -1, 0, 0,  //
      0, -1, 0;
  return r;
}

}  // namespace foretrack
