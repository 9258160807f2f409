// SPDX-License-Identifier: Apache-2.0
#include "core/fleet/fleet_state.hpp"

#include <algorithm>

namespace foretrack {
namespace {

bool is_newer(const FleetMember& message, const FleetPeer& known, double now_s,
              const FleetParams& params) {
  return message.stamp_s > known.told.stamp_s ||
         (now_s - known.heard_s > params.silent_s && message.stamp_s != known.told.stamp_s);
}

}  // namespace

void hear(FleetState& state, const FleetMember& message, double now_s, const FleetParams& params) {
  const auto before = [](const FleetPeer& peer, std::string_view name) {
    return peer.told.vehicle.view() < name;
  };
  const auto begin = state.peers.begin(), end = begin + state.count;
  const auto place = std::lower_bound(begin, end, message.vehicle.view(), before);
  if (place != end && place->told.vehicle == message.vehicle) {
    if (!is_newer(message, *place, now_s, params)) return;
  } else {
    if (state.count == static_cast<int>(state.peers.size())) return;
    std::move_backward(place, end, end + 1);
    *place = {};
    ++state.count;
  }
  place->told = message;
  place->heard_s = now_s;
}

void forget(FleetState& state, double now_s, const FleetParams& params) {
  const auto end = state.peers.begin() + state.count;
  const auto kept = std::remove_if(state.peers.begin(), end, [&](const FleetPeer& peer) {
    return now_s - peer.heard_s > params.forget_s;
  });
  state.count = static_cast<int>(kept - state.peers.begin());
}

}  // namespace foretrack
