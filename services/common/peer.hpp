// SPDX-License-Identifier: Apache-2.0
// Who else is in the domain, as discovery tells.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace foretrack {

/// What the ids of all endpoints of one participant begin with.
using PeerId = std::array<std::uint8_t, 12>;

struct Peer {
  PeerId id{};
  std::string name;      // "uav1/planning"
  double lease_s = 0.0;  // discovery drops it when no message of any kind came for so long
  double since_s = 0.0;  // of its discovery, by the steady clock
};

}  // namespace foretrack
