// SPDX-License-Identifier: Apache-2.0
// Who sees whom from which side, so that the person stays in sight whatever they do next.
#pragma once

#include <span>

#include "core/fleet/fleet_member.hpp"
#include "core/fleet/fleet_params.hpp"

namespace foretrack {

/// One vehicle's part.
struct FleetPart {
  ShortText vehicle;
  SeatRing ring = SeatRing::kFar;
  Seat seat;                                 ///< none: from anywhere in the ring
  std::array<float, kMaxIntentions> sees{};  ///< as it bids for the seat
};

/// The parts of all who follow one person, by name.
struct FleetDivision {
  int count = 0;
  std::array<FleetPart, kFleetCapacity> parts{};
  int intention_count = 0;
  std::array<double, kMaxIntentions> intentions{};  ///< probabilities, agreed among them
  double union_visibility = 0.0;  ///< share of the next time in which somebody sees the person

  std::span<const FleetPart> all() const { return {parts.data(), static_cast<std::size_t>(count)}; }
  /// Null: it has none.
  const FleetPart* part_of(std::string_view vehicle) const;
};

/// The mean over those who see the person now, or over all if nobody does.
void agree_on_intentions(std::span<const FleetMember> members, FleetDivision& out);

/// Gives each its seat. One keeps the near ring, the others stand behind. The seats are those of
/// the greatest expected sight, seen by at least one, over all intentions, less what ways, lines of
/// sight through other vehicles and vehicles in the picture cost; and, where all that is equal,
/// evenly round the person. From the seats that are held, one vehicle after the other takes its
/// best, until nobody wants another (at most four rounds). members: in one frame, sorted by name,
/// all following the same person. The same messages give the same division everywhere. Cost:
/// members² · 24 · intentions, some 20 µs for three.
FleetDivision divide(std::span<const FleetMember> members, const FleetParams& params);

}  // namespace foretrack
