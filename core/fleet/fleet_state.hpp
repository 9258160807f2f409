// SPDX-License-Identifier: Apache-2.0
// What one vehicle keeps of its fleet from step to step.
#pragma once

#include "core/fleet/align_frame.hpp"

namespace foretrack {

/// How far another vehicle is believed.
enum class FleetTrust : std::uint8_t {
  kOwn,        ///< this vehicle itself
  kCommon,     ///< its frame is ours
  kAligned,    ///< its frame was aligned with ours
  kUnaligned,  ///< kept clear of as far as its place is known, not believed
  kLiar,       ///< where it sees the person is not where we see them
};

/// Another vehicle.
struct FleetPeer {
  FleetMember told;       ///< the newest message, in its own frame
  double heard_s = -1e9;  ///< our time
  AlignmentSums pairs;
  FrameAlignment alignment;
  double disagrees_since_s = -1.0;  ///< about the person; negative: it does not
  FleetTrust trust = FleetTrust::kUnaligned;
  FleetMember ours;  ///< the same message in our frame
};

/// All others, sorted by name. A plain value that the caller owns, one for each vehicle.
struct FleetState {
  int count = 0;
  std::array<FleetPeer, kFleetCapacity - 1> peers;
  std::uint32_t sequence_number = 0;  ///< of the newest message of ours
  Seat seat;                          ///< that we hold
  bool is_near = false;               ///< we are the one in the band

  std::span<FleetPeer> all() { return {peers.data(), static_cast<std::size_t>(count)}; }
  std::span<const FleetPeer> all() const { return {peers.data(), static_cast<std::size_t>(count)}; }
};

/// Takes a message of another vehicle: the newest counts, in whatever order they come. A vehicle
/// beyond those that there is room for is left out. One that was silent for so long that it may
/// have begun anew counts from its first number on.
void hear(FleetState& state, const FleetMember& message, double now_s, const FleetParams& params);

/// Forgets those who were not heard for forget_s.
void forget(FleetState& state, double now_s, const FleetParams& params);

}  // namespace foretrack
