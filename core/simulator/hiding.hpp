// SPDX-License-Identifier: Apache-2.0
// Scenes in which the followed person walks out of sight to where the vehicle cannot follow, and
// comes back: by kind and seed.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace foretrack {

struct Scenario;

/// Where somebody hides.
enum class HidingKind : std::uint8_t {
  kWall,   // behind a long wall with narrow doors: in by one, out by another or the same
  kRooms,  // in rooms along a street; some of their doors are wide enough for the vehicle
  kStreet  // in a narrow alley through a block, or in a court inside it
};
inline constexpr std::array<std::string_view, 3> kHidingKindNames = {"wall", "rooms", "street"};
/// For logs and displays.
constexpr std::string_view to_string(HidingKind kind) {
  return kHidingKindNames[static_cast<std::size_t>(kind)];
}

/// Fills the scenario's world and walk for a kind of hiding, from its seed, with its speed and its
/// duration: they are out of reach for 2 to 20 s, walk at 0.5 to 1.5 m/s, stand about inside if the
/// way is short, and walk on for more than 10 s after. Narrow doors are 0.62 to 0.66 m wide.
void stage_hiding(HidingKind kind, Scenario& scenario);

}  // namespace foretrack
