// SPDX-License-Identifier: Apache-2.0
#include "core/perception/person_memory.hpp"

#include <algorithm>

namespace foretrack {
namespace {

// Standard deviations; lengths in sizes of the region.
constexpr double kPlace = 0.03, kPlaceGrowth_1_s = 0.15;
constexpr double kSize = 0.04, kSizeGrowth_1_s = 0.05;  // of its logarithm
constexpr double kClothes = 0.12;
constexpr double kMostGrowth_s = 5.0;
constexpr double kClothesLearnt = 0.05, kVelocityLearnt = 0.3,
                 kDoubtedSizeLearnt = 0.03;  // of what is new in each image
constexpr double kSameVelocity_s = 0.25;     // not measured over a longer time

double square(double value) {
  return value * value;
}

double age_of(const PersonMemory& person, double stamp_s) {
  return std::clamp(stamp_s - person.seen_s, 0.0, kMostGrowth_s);
}

}  // namespace

TorsoPlace place_at(const PersonMemory& person, double stamp_s) {
  const double age_s = age_of(person, stamp_s);
  return {person.torso_px + age_s * person.velocity_px_s,
          (kPlace + kPlaceGrowth_1_s * age_s) * person.size_px};
}

double unlikeness(const PersonMemory& person, const TorsoPlace& place, double stamp_s,
                  const PersonPose& pose, const std::optional<Appearance>& seen) {
  const double age_s = age_of(person, stamp_s);
  const double grown = std::log(pose.tracked.size_px / person.size_px);
  double sum = (pose.torso_px() - place.px).squaredNorm() / square(place.sigma_px) +
               square(grown / (kSize + kSizeGrowth_1_s * age_s));
  if (seen && person.wears) sum += square(difference(*seen, *person.wears) / kClothes);
  return sum;
}

void remember(PersonMemory& person, const PersonPose& pose, const std::optional<Appearance>& seen,
              double stamp_s, bool alone) {
  const double dt_s = stamp_s - person.seen_s;
  const Vec2 torso_px = pose.torso_px();
  if (dt_s > kSameVelocity_s)
    person.velocity_px_s.setZero();
  else if (dt_s > 0.0)
    person.velocity_px_s +=
        kVelocityLearnt * ((torso_px - person.torso_px) / dt_s - person.velocity_px_s);
  if (seen && person.wears && alone) learn(*person.wears, *seen, kClothesLearnt);
  if (seen && !person.wears) person.wears = seen;
  person.region = pose.tracked;
  person.torso_px = torso_px;
  const double size_learnt = alone || !person.known() ? 1.0 : kDoubtedSizeLearnt;
  person.size_px += size_learnt * (pose.tracked.size_px - person.size_px);
  person.seen_s = stamp_s;
}

}  // namespace foretrack
