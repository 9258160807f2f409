// SPDX-License-Identifier: Apache-2.0
// A fault that does not flicker.
#pragma once

namespace foretrack {

/// On as soon as the fault lasts for confirm_s, off when it has been away for clear_s.
struct Latch {
  bool on = false;
  double changed_s = -1e18;  // since when the fault says the other thing than `on`
  bool differs = false;

  bool update(bool fault, double now_s, double confirm_s, double clear_s) {
    if (fault == on) {
      differs = false;
      return on;
    }
    if (!differs) changed_s = now_s;
    differs = true;
    if (now_s - changed_s >= (on ? clear_s : confirm_s)) {
      on = fault;
      differs = false;
    }
    return on;
  }
};

}  // namespace foretrack
