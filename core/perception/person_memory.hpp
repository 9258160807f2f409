// SPDX-License-Identifier: Apache-2.0
// What is known of a person in the image, and how unlike them a pose is.
#pragma once

#include <optional>

#include "core/perception/appearance.hpp"
#include "core/perception/find_landmarks.hpp"

namespace foretrack {

/// What was seen of a person last. A plain value.
struct PersonMemory {
  std::optional<ImageRegion> region;  ///< where they are looked for next; none: not tracked
  Vec2 torso_px = Vec2::Zero();       ///< the torso's middle in the image
  Vec2 velocity_px_s = Vec2::Zero();  ///< how it moves there
  double size_px = 0.0;               ///< of the region: 1.25 times the body's; 0: not known
  double seen_s = -1e9;               ///< stamp of the image
  std::optional<Appearance> wears;    ///< none: their clothes have not been seen
  /// True once they have been seen.
  bool known() const { return size_px > 0.0; }
};

/// Where a torso should be in the image.
struct TorsoPlace {
  Vec2 px = Vec2::Zero();
  double sigma_px = 0.0;  ///< standard deviation on each axis
};

/// Where the person's torso is at a stamp, if it goes on as it moved. The uncertainty grows for
/// five seconds and then no more.
TorsoPlace place_at(const PersonMemory& person, double stamp_s);

/// How unlike a person a pose is: the sum of the squares of its differences in place, size and
/// clothes, each in standard deviations. 0: the same. Above about 9: somebody else, or half of each
/// of two people. Clothes count if both are known. Precondition: the person is known.
double unlikeness(const PersonMemory& person, const TorsoPlace& place, double stamp_s,
                  const PersonPose& pose, const std::optional<Appearance>& seen);

/// Takes a pose as the person's. `alone`: nobody else is near enough to be part of the pose. If
/// somebody is, nothing is learnt of the clothes, and little of the size.
void remember(PersonMemory& person, const PersonPose& pose, const std::optional<Appearance>& seen,
              double stamp_s, bool alone);

}  // namespace foretrack
