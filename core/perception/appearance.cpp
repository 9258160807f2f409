// SPDX-License-Identifier: Apache-2.0
#include "core/perception/appearance.hpp"

#include "core/perception/torso_points.hpp"

namespace foretrack {
namespace {

constexpr int kColorSteps = 8;   // samples a side
constexpr double kSides = 0.15;  // of the torso, left out at each side
constexpr double kDark = 12.0;   // so that the colour of black is not noise
constexpr double kBrightness = 0.4;
constexpr int kLeastSamples = kColorSteps * kColorSteps / 4;  // of a half

}  // namespace

std::optional<Appearance> appearance_of(const RgbImage& image, const PersonPose& person) {
  std::array<Vec3, 2> sums{Vec3::Zero(), Vec3::Zero()};
  std::array<int, 2> counts{};
  visit_torso(person.landmarks, kColorSteps, kSides, [&](const Vec2& px, int row) {
    if (!(px.x() >= 0.0 && px.y() >= 0.0 && px.x() < image.width_px && px.y() < image.height_px))
      return;
    const std::uint8_t* rgb = image.pixel(static_cast<int>(px.x()), static_cast<int>(px.y()));
    const int half = 2 * row / kColorSteps;
    sums[half] += Vec3(rgb[0], rgb[1], rgb[2]);
    ++counts[half];
  });
  Appearance seen;
  for (int half = 0; half < 2; ++half) {
    if (counts[half] < kLeastSamples) return std::nullopt;
    const Vec3 mean = (sums[half] / counts[half]).array() + kDark;
    seen.colors.segment<3>(3 * half) << std::log(mean.x() / mean.y()),
        std::log(mean.z() / mean.y()), kBrightness * std::log(mean.mean());
  }
  return seen;
}

}  // namespace foretrack
