// SPDX-License-Identifier: Apache-2.0
#include "core/perception/sample_image.hpp"

#include <algorithm>

namespace foretrack {
namespace {

struct Sampler {
  const RgbImage& image;
  Border border;
  float level, offset;

  // Column and row in pixels, where the middle of the first pixel is at 0.5.
  void at(float column, float row, float* out) const {
    const auto width = static_cast<float>(image.width_px);
    const auto height = static_cast<float>(image.height_px);
    if (border == Border::kBlack &&
        !(column >= 0.0f && row >= 0.0f && column <= width && row <= height)) {
      out[0] = out[1] = out[2] = offset;
      return;
    }
    const float x = std::clamp(column - 0.5f, 0.0f, width - 1.0f);
    const float y = std::clamp(row - 0.5f, 0.0f, height - 1.0f);
    const int left = static_cast<int>(x), top = static_cast<int>(y);
    const int right = std::min(left + 1, image.width_px - 1);
    const int bottom = std::min(top + 1, image.height_px - 1);
    const float across = x - static_cast<float>(left), down = y - static_cast<float>(top);
    const std::uint8_t *a = image.pixel(left, top), *b = image.pixel(right, top);
    const std::uint8_t *c = image.pixel(left, bottom), *d = image.pixel(right, bottom);
    for (int k = 0; k < 3; ++k) {
      const float upper = static_cast<float>(a[k]) + across * static_cast<float>(b[k] - a[k]);
      const float lower = static_cast<float>(c[k]) + across * static_cast<float>(d[k] - c[k]);
      out[k] = level * (upper + down * (lower - upper)) + offset;
    }
  }
};

}  // namespace

void sample_region(const RgbImage& image, const ImageRegion& region, Border border, int side,
                   float level, float offset, std::span<float> out) {
  const Sampler sampler{image, border, level / 255.0f, offset};
  const double step = 1.0 / side;
  const Vec2 first = region.image_px({0.5 * step, 0.5 * step});
  const Vec2 across = region.image_px({1.5 * step, 0.5 * step}) - first;
  const Vec2 down(-across.y(), across.x());
  float* to = out.data();
  for (int row = 0; row < side; ++row) {
    const Vec2 start = first + row * down;
    for (int column = 0; column < side; ++column, to += 3)
      sampler.at(static_cast<float>(start.x() + column * across.x()),
                 static_cast<float>(start.y() + column * across.y()), to);
  }
}

}  // namespace foretrack
