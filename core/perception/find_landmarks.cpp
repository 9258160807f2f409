// SPDX-License-Identifier: Apache-2.0
#include "core/perception/find_landmarks.hpp"

#include <algorithm>
#include <cmath>

#include "core/perception/detect_people.hpp"
#include "core/perception/sample_image.hpp"

namespace foretrack {
namespace {

constexpr int kInputSide_px = 256;
constexpr int kMarks = 39;       // with six auxiliary ones
constexpr int kMarkNumbers = 5;  // of a mark: x, y, z, visibility, presence
constexpr int kHeatSide = 64;
constexpr int kReach = 3;  // of the refinement, in cells
constexpr double kLeastHeat = 0.5;
constexpr int kMiddle = 33, kEnd = 34;  // auxiliary: of the body's region
constexpr double kLeastRegion_px = 4.0;
constexpr double kMostRegion_px = 1e6;

double sigmoid(double logit) {
  return 1.0 / (1.0 + std::exp(-logit));
}

// The centre of the heat around a mark, in the region's unit; the mark itself if it is cold there.
Vec2 refined(const Vec2& mark, int index, std::span<const float> heat) {
  const int column = static_cast<int>(mark.x() * kHeatSide);
  const int row = static_cast<int>(mark.y() * kHeatSide);
  // As in the original, a mark below the map is refined by the heat at its lower edge.
  if (column < 0 || row < 0 || column >= kHeatSide) return mark;
  double sum = 0.0, most = 0.0;
  Vec2 weighted = Vec2::Zero();
  for (int r = std::max(0, row - kReach); r <= std::min(kHeatSide - 1, row + kReach); ++r)
    for (int c = std::max(0, column - kReach); c <= std::min(kHeatSide - 1, column + kReach); ++c) {
      const double h =
          sigmoid(heat[static_cast<std::size_t>((r * kHeatSide + c) * kMarks + index)]);
      sum += h;
      most = std::max(most, h);
      weighted += h * Vec2(c, r);
    }
  const bool warm = most >= kLeastHeat && std::isfinite(sum);
  return warm ? Vec2(weighted / (sum * kHeatSide)) : mark;
}

bool all_finite(std::span<const float> values) {
  return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
}

}  // namespace

Vec2 PersonPose::torso_px() const {
  return 0.25 * (landmarks[kLeftShoulder].image_px + landmarks[kRightShoulder].image_px +
                 landmarks[kLeftHip].image_px + landmarks[kRightHip].image_px);
}

std::optional<PersonPose> find_landmarks(const RgbImage& image, const ImageRegion& region,
                                         Inference& network, double min_score) {
  const bool sized = region.size_px >= kLeastRegion_px && region.size_px <= kMostRegion_px;
  if (!sized || !(region.centre_px.norm() < 1e9)) return std::nullopt;
  sample_region(image, region, Border::kRepeated, kInputSide_px, 1.0f, 0.0f, network.input());
  network.run();
  const auto marks = network.output(0), flag = network.output(1), heat = network.output(2),
             world = network.output(3);
  if (!(flag[0] >= min_score) || !all_finite(marks) || !all_finite(world)) return std::nullopt;

  const auto place = [&](int k) -> Vec2 {
    const float* m = &marks[static_cast<std::size_t>(k * kMarkNumbers)];
    if (!(std::abs(m[0]) < 1e6f && std::abs(m[1]) < 1e6f)) return region.centre_px;
    return region.image_px(refined(Vec2(m[0], m[1]) / kInputSide_px, k, heat));
  };
  PersonPose person;
  person.score = flag[0];
  person.region = region;
  const Eigen::Rotation2Dd turn(region.angle_rad);
  for (int k = 0; k < kLandmarkCount; ++k) {
    Landmark& landmark = person.landmarks[k];
    const float* w = &world[static_cast<std::size_t>(3 * k)];
    landmark.image_px = place(k);
    landmark.body_m << turn * Vec2(w[0], w[1]), w[2];
    landmark.visibility = sigmoid(marks[static_cast<std::size_t>(k * kMarkNumbers + 3)]);
  }
  person.tracked = region_of_body(place(kMiddle), place(kEnd));
  return person;
}

}  // namespace foretrack
