// SPDX-License-Identifier: Apache-2.0
// Whether the vehicle's odometry can be believed: its stamps, its jumps, whether it moves at all.
#pragma once

#include "core/common/vehicle.hpp"
#include "core/safety/latch.hpp"
#include "core/safety/mission.hpp"

namespace foretrack {

/// Why the odometry is not believed.
enum class OdometryFault : std::uint8_t { kNone, kJumps, kFrozen, kDisagrees };

/// When odometry is not believed.
struct OdometryParams {
  double oldest_s = 0.3;       // by its stamp, when it comes
  double future_s = 0.1;       // the same
  double jump_m = 0.5;         // from one state to the next, beyond what its velocity tells
  double drift_m = 0.5;        // the same, summed up over about a second
  double frozen_path_m = 0.6;  // it stands still while so much motion is commanded
  double frozen_s = 0.5;       // for so long, since a vehicle begins to move slowly
  double settle_s = 1.0;       // without faults, until it is believed again
};

/// What the odometry has said so far.
struct OdometryWatch {
  VehicleState state;       // the last one that was believed
  double at_s = -1.0;       // when it came, monotonic; −1: none yet
  double seen_at_s = -1.0;  // when the last one came, believed or not
  Vec3 drift_m = Vec3::Zero();
  Vec3 moved_from_m = Vec3::Zero();            // where it was seen to move last
  double still_since_s = 0.0;                  // and since when more was commanded
  double commanded_m = 0.0;                    // path since then
  OdometryFault fault = OdometryFault::kNone;  // until it has settled
  Latch latch;
  std::uint32_t refused = 0;  // states, for their stamps or numbers
};

/// Takes a state that came at at_s. One is refused that is not finite, not newer than the last, or
/// whose stamp is old or ahead: unless the stamps go on as before, so that our clock was set and
/// not theirs. A clock that both read from may be set at any time.
void take_odometry(OdometryWatch& watch, const VehicleState& state, double at_s,
                   const Moment& moment, const OdometryParams& params);

/// Once a tick: what is commanded, against how the vehicle moves. Returns the fault that holds.
OdometryFault watch_odometry(OdometryWatch& watch, const Vec3& commanded_enu_m_s, double dt_s,
                             double now_s, const OdometryParams& params);

}  // namespace foretrack
