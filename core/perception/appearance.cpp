// SPDX-License-Identifier: Apache-2.0
#include "core/perception/appearance.hpp"

#include <algorithm>

#include "core/perception/torso_points.hpp"

namespace foretrack {
namespace {

constexpr int kColorSteps = 8;   // samples a side
constexpr double kSides = 0.15;  // of the torso, left out at each side
constexpr double kDark = 12.0;   // so that the colour of black is not noise
constexpr double kBrightness = 0.4;
constexpr int kLeastSamples = kColorSteps * kColorSteps / 4;  // of a half
constexpr int kAlongSteps = 16;                               // samples along a limb
constexpr double kEnds = 0.15;                                // of a limb, left out
constexpr double kSeen = 0.5;                                 // visibility of a joint
enum LegJoint : int { kLeftKnee = 25, kRightKnee = 26, kLeftAnkle = 27, kRightAnkle = 28 };

Vec3 numbers_of(const Vec3& rgb) {
  const Vec3 color = rgb.array() + kDark;
  return {std::log(color.x() / color.y()), std::log(color.z() / color.y()),
          kBrightness * std::log(color.mean())};
}

/// The mean of an image's pixels at some places.
struct ColorMean {
  Vec3 sum = Vec3::Zero();
  int count = 0;

  void add(const RgbImage& image, const Vec2& px) {
    if (!(px.x() >= 0.0 && px.y() >= 0.0 && px.x() < image.width_px && px.y() < image.height_px))
      return;
    const std::uint8_t* rgb = image.pixel(static_cast<int>(px.x()), static_cast<int>(px.y()));
    sum += Vec3(rgb[0], rgb[1], rgb[2]);
    ++count;
  }
  Vec3 numbers() const { return numbers_of(sum / count); }
};

// Along the middle of both limbs between these joints, without their ends.
ColorMean mean_along(const RgbImage& image, const PersonPose& person,
                     const std::array<std::array<int, 2>, 2>& limbs) {
  ColorMean mean;
  for (const auto& [from, to] : limbs) {
    const Landmark &a = person.landmarks[from], &b = person.landmarks[to];
    if (std::min(a.visibility, b.visibility) < kSeen) continue;
    for (int k = 0; k < kAlongSteps; ++k) {
      const double share = kEnds + (1.0 - 2.0 * kEnds) * (k + 0.5) / kAlongSteps;
      mean.add(image, (1.0 - share) * a.image_px + share * b.image_px);
    }
  }
  return mean;
}

// The numbers are left alone where too little of the legs is seen.
void look_at_legs(const RgbImage& image, const PersonPose& person, Appearance& seen) {
  const ColorMean thighs =
      mean_along(image, person, {{{kLeftHip, kLeftKnee}, {kRightHip, kRightKnee}}});
  const ColorMean shanks =
      mean_along(image, person, {{{kLeftKnee, kLeftAnkle}, {kRightKnee, kRightAnkle}}});
  seen.legs_seen = std::min(thighs.count, shanks.count) >= kAlongSteps / 2;
  if (seen.legs_seen) seen.legs << thighs.numbers(), shanks.numbers();
}

}  // namespace

std::optional<Appearance> appearance_of(const RgbImage& image, const PersonPose& person) {
  std::array<ColorMean, 2> halves;
  visit_torso(person.landmarks, kColorSteps, kSides, [&](const Vec2& px, int row) {
    halves[static_cast<std::size_t>(2 * row / kColorSteps)].add(image, px);
  });
  if (std::min(halves[0].count, halves[1].count) < kLeastSamples) return std::nullopt;
  Appearance seen;
  seen.colors << halves[0].numbers(), halves[1].numbers();
  look_at_legs(image, person, seen);
  return seen;
}

double difference_from_color(const Appearance& seen, const Vec3& rgb) {
  const Vec3 torso = 0.5 * (seen.colors.head<3>() + seen.colors.tail<3>());
  return (torso - numbers_of(rgb)).norm();
}

}  // namespace foretrack
