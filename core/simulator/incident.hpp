// SPDX-License-Identifier: Apache-2.0
// What may come between a flight and its plan: a pilot who takes over, the flight controller's own
// failsafes, commands that it does not answer.
#pragma once

#include <array>
#include <string_view>

#include "core/common/vehicle.hpp"

namespace foretrack {

/// What goes wrong.
enum class IncidentKind : std::uint8_t {
  kMode,       // a pilot changes the mode
  kSticks,     // a pilot moves the sticks
  kDisarm,     // a pilot disarms by force, wherever the vehicle is
  kGeofence,   // failsafe: hold
  kBattery,    // failsafe: return
  kLink,       // failsafe: return
  kWell,       // what the failsafe was for is over
  kTerminate,  // the motors stop for good
  kDeny,       // from now on commands are denied
  kIgnore,     // from now on commands are neither obeyed nor answered
  kObey,       // from now on commands are obeyed again
};
inline constexpr std::array<std::string_view, 11> kIncidentNames = {
    "mode", "sticks",    "disarm", "geofence", "battery", "link",
    "well", "terminate", "deny",   "ignore",   "obey"};
inline constexpr std::array<std::string_view, 9> kFlightModeNames = {
    "unknown", "offboard", "pilot", "hold", "take_off", "return", "land", "termination", "other"};
/// As scenario files have it.
constexpr std::string_view to_string(FlightMode mode) {
  return kFlightModeNames[static_cast<std::size_t>(mode)];
}

/// Something that goes wrong at a given time.
struct Incident {
  double at_s = 0.0;
  IncidentKind kind = IncidentKind::kSticks;
  FlightMode mode = FlightMode::kPilot;  // of kMode
};

}  // namespace foretrack
