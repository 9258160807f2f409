// SPDX-License-Identifier: Apache-2.0
// One step of a fleet's coordination: from what this vehicle knows and what it last heard of the
// others to its own seat, what it keeps clear of, and where the person is.
#pragma once

#include "core/common/grid_map.hpp"
#include "core/common/moving_body.hpp"
#include "core/common/vehicle.hpp"
#include "core/fleet/divide.hpp"
#include "core/fleet/fleet_state.hpp"

namespace foretrack {

/// What this vehicle knows. World ENU of `frame`. What pointers lead to is read during the call
/// only.
struct FleetInput {
  double now_s = 0.0;
  ShortText vehicle, frame;  ///< names
  VehicleState state;
  double radius_m = 0.25;
  double battery = -1.0;     ///< of a full one; negative: not known
  bool flies = true;         ///< follows, or is ready to
  double gap_min_m = 0.5;    ///< that its planner keeps from any body
  TargetState target;        ///< by its own eyes
  std::uint32_t person = 1;  ///< its own number of them
  const Prediction* prediction = nullptr;
  const IntentionAssessment* intention = nullptr;
  const PlannedTrajectory* plan = nullptr;
  const GridMap* map = nullptr;
};

/// Where the person is to be seen from.
struct SeatPlace {
  bool is_alone = true;  ///< nobody else follows the person: all that follows is nothing
  SeatRing ring = SeatRing::kNear;
  Seat seat;                 ///< none: in any direction
  double bearing_rad = 0.0;  ///< of the vehicle from the person, world; with a seat
  double distance_m = 0.0;
  /// Over the torso's centre; 0: as usual. Where vehicles do not hear each other, each part of the
  /// fleet has a layer of its own.
  double height_m = 0.0;
};

struct FleetResult {
  FleetMember message;     ///< to be told to the others
  FleetDivision division;  ///< of all who follow the same person and are believed
  SeatPlace place;
  MovingBodies peers;  ///< to be kept clear of
  TargetState target;  ///< by its own eyes, or by the others' when it does not see them
  double separation_m =
      0.0;  ///< hull to hull, least of the pairs with this vehicle; infinite alone
};

/// Align frames → fuse the target → bid for seats → divide → bodies. Deterministic: the same
/// messages give the same division to every vehicle that has heard them. The messages are taken
/// before, by hear(). Cost: 0.1 ms for the bids, and some 20 µs for three vehicles; allocates
/// nothing.
FleetResult coordinate(FleetState& state, const FleetInput& input, const FleetParams& params);

}  // namespace foretrack
