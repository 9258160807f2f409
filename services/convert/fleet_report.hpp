// SPDX-License-Identifier: Apache-2.0
// What a vehicle makes of what its fleet tells.
#pragma once

#include "core/fleet/coordinate.hpp"
#include "foretrack_msgs/msg/FleetDivision.h"
#include "services/convert/checks.hpp"

namespace foretrack {

/// Another vehicle, as far as it was heard.
struct FleetPeerReport {
  ShortText vehicle;
  FleetTrust trust = FleetTrust::kUnaligned;
  double age_s = 0.0;
  Vec3 position_enu_m = Vec3::Zero();
  double separation_m = 0.0;  // hull to hull
};

/// A division as the world may know it.
struct FleetReport {
  double stamp_s = 0.0;
  ShortText vehicle;  // that computed it
  SeatPlace place;    // its own
  FleetDivision division;
  double separation_m = 0.0;  // hull to hull, to the nearest other
  int peer_count = 0;
  std::array<FleetPeerReport, kFleetCapacity - 1> peers = {};
};
/// Of one that has coordinated just now.
FleetReport report_of(const FleetState& state, const FleetResult& result);
void to_idl(const FleetReport& report, foretrack_msgs::msg::FleetDivision& out);
Converted<FleetReport> from_idl(const foretrack_msgs::msg::FleetDivision& in);

}  // namespace foretrack
