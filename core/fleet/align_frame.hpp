// SPDX-License-Identifier: Apache-2.0
// Another vehicle's frame, aligned with ours by a person whom both see.
#pragma once

#include "core/fleet/fleet_member.hpp"
#include "core/fleet/fleet_params.hpp"

namespace foretrack {

/// Turns the other's world about z, then shifts it into ours.
struct FrameAlignment {
  double yaw_rad = 0.0;
  Vec3 shift_m = Vec3::Zero();
  double yaw_sigma_rad = kPi;
  double position_sigma_m = 1e3;  ///< where the person is

  Vec3 place(const Vec3& theirs_m) const { return turned(theirs_m) + shift_m; }
  Vec3 turned(const Vec3& theirs) const;
  bool is_sure(const FleetParams& params) const {
    return yaw_sigma_rad < params.align_yaw_rad && position_sigma_m < params.align_position_m;
  }
};

/// What is kept of pairs of places: weighted sums, so that old ones fade.
struct AlignmentSums {
  double stamp_s = -1e9;  ///< of the newest pair
  double weight = 0.0;
  Vec3 theirs_m = Vec3::Zero(), ours_m = Vec3::Zero();  ///< means
  double theirs_m2 = 0.0, ours_m2 = 0.0;                ///< horizontal spread about the means
  double dot_m2 = 0.0, cross_m2 = 0.0;                  ///< of theirs with ours, the same
};

/// One more pair of places at which both see the person; pairs nearer in time than 0.1 s are left
/// out. sigma_m: of the two places together.
void add_pair(AlignmentSums& sums, double stamp_s, const Vec3& theirs_m, const Vec3& ours_m,
              const FleetParams& params);

/// The rigid motion of least squares over the pairs (Umeyama 1991, in the plane), and how sure it
/// is, by what remains and by how far the person has walked. Errors of estimates of one person hold
/// for about a second: a pair counts as much as they are independent.
FrameAlignment align_frame(const AlignmentSums& sums);

/// The message as if it had been told in our frame. Its covariances grow by the alignment's.
FleetMember in_our_frame(FleetMember member, const FrameAlignment& alignment);

}  // namespace foretrack
