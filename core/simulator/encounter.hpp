// SPDX-License-Identifier: Apache-2.0
// Scenes in which people come near a vehicle that follows somebody: by kind, speed and seed.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/simulator/bystander.hpp"

namespace foretrack {

struct Scenario;

/// How somebody comes near.
enum class EncounterKind : std::uint8_t {
  kHeadOn,       // the followed person walks at the vehicle, or bystanders come along the way
  kTurnBack,     // the followed person turns round, again and again
  kStop,         // the followed person, or somebody beside them, stops before the vehicle
  kCrossBefore,  // between the vehicle and the followed person
  kCrossBehind,  // behind the vehicle
  kTowards,      // from some side straight to where the vehicle will be
  kGroup         // two to eight together, along the way or across it
};
inline constexpr std::array<std::string_view, 7> kEncounterKindNames = {
    "head_on", "turn_back", "stop", "cross_before", "cross_behind", "towards", "group"};
/// For logs and displays.
constexpr std::string_view to_string(EncounterKind kind) {
  return kEncounterKindNames[static_cast<std::size_t>(kind)];
}

/// Where it happens.
enum class EncounterPlace : std::uint8_t { kOpen, kCorridor, kDeadEnd, kJunction };
inline constexpr std::array<std::string_view, 4> kEncounterPlaceNames = {"open", "corridor",
                                                                         "dead_end", "junction"};
/// For logs and displays.
constexpr std::string_view to_string(EncounterPlace place) {
  return kEncounterPlaceNames[static_cast<std::size_t>(place)];
}

/// A meeting that is staged: its kind, its place, and who takes part.
struct Encounter {
  EncounterKind kind = EncounterKind::kHeadOn;
  EncounterPlace place = EncounterPlace::kOpen;  // drawn from the seed
};

/// Fills the scenario's world, walks and vehicle for a kind of encounter, from its seed, its
/// duration and the target's speed: that is the speed of those who come near. Nobody makes way for
/// the vehicle. Corridors are 1.6–4 m wide.
void stage_encounter(EncounterKind kind, Scenario& scenario);

}  // namespace foretrack
