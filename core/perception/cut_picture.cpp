// SPDX-License-Identifier: Apache-2.0
#include "core/perception/cut_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace foretrack {
namespace {

constexpr double kAroundBox = 0.1;  // of the box's height, on each side

/// Columns or rows of the image.
struct Span {
  int begin = 0, end = 0;
  int size() const { return end - begin; }
};

Span span_of(double low, double high, int size) {
  const auto clamped = [&](double v) { return std::clamp(v, 0.0, static_cast<double>(size)); };
  return {static_cast<int>(std::floor(clamped(low))), static_cast<int>(std::ceil(clamped(high)))};
}

// What the i-th of `count` parts of the span stands for.
Span part(const Span& whole, int i, int count) {
  const auto edge = [&](int k) {
    return whole.begin + static_cast<int>(static_cast<long>(whole.size()) * k / count);
  };
  return {edge(i), std::max(edge(i + 1), edge(i) + 1)};
}

void add_mean(const RgbImage& image, const Span& columns, const Span& rows,
              std::vector<std::uint8_t>& out) {
  std::array<int, 3> sum{};
  for (int y = rows.begin; y < rows.end; ++y)
    for (int x = columns.begin; x < columns.end; ++x)
      for (int c = 0; c < 3; ++c) sum[c] += image.pixel(x, y)[c];
  const int count = columns.size() * rows.size();
  for (const int s : sum) out.push_back(static_cast<std::uint8_t>((s + count / 2) / count));
}

}  // namespace

RgbImage cut_picture(const RgbImage& image, const Vec2& low_px, const Vec2& high_px, int most_px) {
  RgbImage out;
  const double around_px = kAroundBox * (high_px.y() - low_px.y());
  if (!(around_px >= 0.0) || !low_px.allFinite() || !high_px.allFinite()) return out;
  const Span columns = span_of(low_px.x() - around_px, high_px.x() + around_px, image.width_px);
  const Span rows = span_of(low_px.y() - around_px, high_px.y() + around_px, image.height_px);
  if (columns.size() <= 0 || rows.size() <= 0 || most_px <= 0) return out;
  const double scale =
      std::min(1.0, static_cast<double>(most_px) / std::max(columns.size(), rows.size()));
  const auto scaled = [&](int size) { return std::max(1, static_cast<int>(scale * size)); };
  out.width_px = scaled(columns.size());
  out.height_px = scaled(rows.size());
  out.rgb.reserve(3 * static_cast<std::size_t>(out.width_px) *
                  static_cast<std::size_t>(out.height_px));
  for (int y = 0; y < out.height_px; ++y)
    for (int x = 0; x < out.width_px; ++x)
      add_mean(image, part(columns, x, out.width_px), part(rows, y, out.height_px), out.rgb);
  return out;
}

}  // namespace foretrack
