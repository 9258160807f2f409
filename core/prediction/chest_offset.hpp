// SPDX-License-Identifier: Apache-2.0
// Where the chest of somebody points while they walk, against where they go: straight ahead, as a
// rule; aside, who carries something; backwards, who walks so or whom a detector takes for turned.
#pragma once

#include <limits>

#include "core/prediction/motion_history.hpp"

namespace foretrack {

/// A slow circular mean of the chest's angle to the course, left being positive; and whether a
/// detector takes the back for the front just now. Owned by the caller of predict().
struct ChestOffset {
  Vec2 mean_s = Vec2::Zero();  ///< unit vectors, each times how long it was seen; forgotten
  double stamp_s = 0.0;
  bool flipped = false;                                       ///< since a jump to the other side
  double yaw_rad = std::numeric_limits<double>::quiet_NaN();  ///< as seen last
  double seen_s = 0.0;

  /// As far as it can be told from what was seen; 0 at first.
  double angle_rad() const;
};

/// The chest's yaw without the jumps to the other side that no body makes. NaN: not known.
double unflipped_yaw_rad(ChestOffset& offset, const TargetState& target);

/// Follows one estimate, which is the newest of the history. Only who walks straight on counts, and
/// the chest of half a second ago: one that turns ahead of the path is not one that points aside.
void follow(ChestOffset& offset, const MotionHistory& history, const TargetState& target);

}  // namespace foretrack
