// SPDX-License-Identifier: Apache-2.0
// Networks that answer what the test wants, in the shape of the real ones.
#pragma once

#include <cmath>
#include <vector>

#include "core/perception/perceive_image.hpp"

namespace foretrack::testing {

class FakeInference : public Inference {
 public:
  FakeInference(std::size_t input, const std::vector<std::size_t>& outputs) : input_(input) {
    for (const std::size_t size : outputs) outputs_.emplace_back(size);
  }
  std::span<float> input() override { return input_; }
  void run() override { ++runs; }
  std::span<const float> output(std::size_t index) const override { return outputs_.at(index); }
  std::vector<float>& answer(std::size_t index) { return outputs_.at(index); }
  int runs = 0;

 private:
  std::vector<float> input_;
  std::vector<std::vector<float>> outputs_;
};

/// The detector's and the landmark network's answers, set by the test.
struct FakePoseNetwork {
  static constexpr int kAnchors = 2254;
  FakeInference* detector = new FakeInference(224 * 224 * 3, {kAnchors * 12, kAnchors});
  FakeInference* landmarks = new FakeInference(256 * 256 * 3, {195, 1, 64 * 64 * 39, 117});
  PoseNetwork network{std::unique_ptr<Inference>(detector), std::unique_ptr<Inference>(landmarks)};

  FakePoseNetwork() {
    see_nobody();
    std::fill(landmarks->answer(2).begin(), landmarks->answer(2).end(), -10.0f);  // cold
    answer_person();
  }
  void see_nobody() { std::fill(detector->answer(1).begin(), detector->answer(1).end(), -10.0f); }
  /// A person, in [0, 1] of the letterboxed image, at the 14 × 14 anchor nearest to the torso: the
  /// hips' middle is half of `half_size` below the torso's, the end of the body `half_size` above
  /// the hips.
  void see(const Vec2& torso, double half_size, double logit) {
    const int column = std::min(13, static_cast<int>(torso.x() * 14));
    const int row = std::min(13, static_cast<int>(torso.y() * 14));
    const int k = 1568 + 2 * (14 * row + column);
    const Vec2 anchor((column + 0.5) / 14, (row + 0.5) / 14);
    detector->answer(1)[k] = static_cast<float>(logit);
    float* numbers = &detector->answer(0)[12 * k];
    const auto put = [&](int at, const Vec2& value) {
      numbers[at] = static_cast<float>(224.0 * value.x());
      numbers[at + 1] = static_cast<float>(224.0 * value.y());
    };
    const Vec2 hips = torso + Vec2(0.0, 0.25 * half_size) - anchor;
    put(0, torso - anchor);
    put(2, {0.2, 0.2});
    put(4, hips);
    put(6, hips - Vec2(0.0, half_size));
    put(8, hips - Vec2(0.0, 0.5 * half_size));
    put(10, hips - Vec2(0.0, half_size));
  }
  /// Upright in the middle of the region, where see() would detect them, moved by `offset` (of the
  /// region's side).
  void answer_person(double score = 0.99, const Vec2& offset = Vec2::Zero()) {
    auto& marks = landmarks->answer(0);
    const auto put = [&](int k, const Vec2& at) {
      marks[5 * k] = static_cast<float>(256.0 * (at.x() + offset.x()));
      marks[5 * k + 1] = static_cast<float>(256.0 * (at.y() + offset.y()));
      marks[5 * k + 3] = marks[5 * k + 4] = 5.0f;
    };
    for (int k = 0; k < 39; ++k) put(k, {0.5, 0.5});
    put(kLeftShoulder, {0.6, 0.3});
    put(kRightShoulder, {0.4, 0.3});
    put(kLeftHip, {0.55, 0.5});
    put(kRightHip, {0.45, 0.5});
    put(33, {0.5, 0.5});
    put(34, {0.5, 0.1});
    landmarks->answer(1)[0] = static_cast<float>(score);
  }
};

inline RgbImage grey_image(int width_px, int height_px, std::uint8_t level = 90) {
  RgbImage image{width_px, height_px, {}};
  image.rgb.assign(3u * width_px * height_px, level);
  return image;
}

}  // namespace foretrack::testing
