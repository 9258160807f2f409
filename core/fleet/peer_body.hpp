// SPDX-License-Identifier: Apache-2.0
// Another vehicle as a moving body that search, optimiser, check and gate keep clear of.
#pragma once

#include "core/common/moving_body.hpp"
#include "core/common/target.hpp"
#include "core/fleet/fleet_member.hpp"
#include "core/fleet/fleet_params.hpp"

namespace foretrack {

/// How the body is seen.
struct PeerView {
  double now_s = 0.0;
  Vec3 own_enu_m = Vec3::Zero();        ///< this vehicle is here: nobody else is
  double gap_min_m = 0.5;               ///< that the planner keeps from any body by itself
  bool gives_way = false;               ///< this vehicle has to
  double frame_sigma_m = 0.0;           ///< of the alignment of its frame
  const TargetState* person = nullptr;  ///< whom both follow; null: nobody is known
};

/// An upright cylinder that holds the other's hull, what is kept from it, and its downwash; its
/// places are those of its plan. It grows as the message ages: by what a vehicle may leave its
/// plan, and after silent_s, when the other stops, by how far it may be from there.
MovingBody peer_body(const FleetMember& peer, const PeerView& view, const FleetParams& params);

/// A silent peer may as well follow on: the body goes on beside the person where it was, and keeps
/// its size. Precondition: view.person is usable. False: it is heard, or never knew the person.
bool following_body(const FleetMember& peer, const PeerView& view, const FleetParams& params,
                    MovingBody& body);

/// Who gives way: the one whose name is the greater. No two wait for each other.
bool gives_way(const FleetMember& own, const FleetMember& peer);

}  // namespace foretrack
