// SPDX-License-Identifier: Apache-2.0
// What is known of a person in the image, and how unlike them a pose is.
#pragma once

#include <optional>

#include "core/perception/appearance.hpp"
#include "core/perception/find_landmarks.hpp"

namespace foretrack {

/// What was seen of a person last. A plain value.
struct PersonMemory {
  std::optional<ImageRegion> region;  // where they are looked for next; none: not tracked
  Vec2 torso_px = Vec2::Zero();
  Vec2 velocity_px_s = Vec2::Zero();
  double size_px = 0.0;  // of the region, which is 1.25 times as large as the body; 0: not known
  double seen_s = -1e9;
  std::optional<Appearance> wears;
  bool known() const { return size_px > 0.0; }
};

/// Where a torso should be in the image.
struct TorsoPlace {
  Vec2 px = Vec2::Zero();
  double sigma_px = 0.0;
};

/// Goes on as it moved, less and less certain.
TorsoPlace place_at(const PersonMemory& person, double stamp_s);

/// Of a pose's place, size and clothes from the person's: sum of the squares in standard deviations
/// (0: the same; above about 9: somebody else, or half of each of two).
double unlikeness(const PersonMemory& person, const TorsoPlace& place, double stamp_s,
                  const PersonPose& pose, const std::optional<Appearance>& seen);

/// The pose is theirs. `alone`: nobody else is near enough to be part of it; otherwise nothing is
/// learnt of the clothes, and little of the size.
void remember(PersonMemory& person, const PersonPose& pose, const std::optional<Appearance>& seen,
              double stamp_s, bool alone);

}  // namespace foretrack
