// SPDX-License-Identifier: Apache-2.0
#include "core/perception/search_window.hpp"

#include <algorithm>
#include <array>

#include "core/perception/detect_people.hpp"

namespace foretrack {
namespace {

constexpr double kBodiesAcross = 2.0;  // of the smallest window
constexpr double kEnoughBodies = 3.5;  // a window of so many needs no parts
// Of the nine parts, in halves of the side from the middle; people are rarely at the top.
constexpr std::array<std::array<double, 2>, 9> kParts = {
    {{0, 0}, {-1, 0}, {1, 0}, {0, 1}, {-1, 1}, {1, 1}, {0, -1}, {-1, -1}, {1, -1}}};

struct Windows {
  std::array<ImageRegion, kMostWindows> items;
  int count = 0;
  void add(const RgbImage& image, const ImageRegion& window) {
    const double half = 0.5 * window.size_px;
    const Vec2 low = window.centre_px.array() - half, high = window.centre_px.array() + half;
    const bool sees_image =
        low.x() < image.width_px && low.y() < image.height_px && high.x() > 0 && high.y() > 0;
    if (sees_image) items[count++] = window;
  }
};

ImageRegion area_of(const RgbImage& image, const std::optional<ExpectedPlace>& place) {
  const ImageRegion whole = whole_of(image);
  if (!place) return whole;
  const double wanted_px =
      std::max(2.0 * place->gate_px + place->body_px, kBodiesAcross * place->body_px);
  return wanted_px < whole.size_px ? ImageRegion{place->torso_px, wanted_px, 0.0} : whole;
}

bool may_be_in(const RgbImage& image, const ExpectedPlace& place) {
  const Vec2 size(image.width_px, image.height_px);
  const Vec2 nearest = place.torso_px.cwiseMax(Vec2::Zero()).cwiseMin(size);
  return (nearest - place.torso_px).norm() <= place.gate_px;
}

}  // namespace

std::optional<ImageRegion> search_window(const RgbImage& image,
                                         const std::optional<ExpectedPlace>& place, int look) {
  if (place && !may_be_in(image, *place)) return std::nullopt;
  const ImageRegion area = area_of(image, place);
  Windows windows;
  windows.add(image, area);
  if (!place || area.size_px > kEnoughBodies * place->body_px)
    for (const auto& [x, y] : kParts)
      windows.add(image,
                  {area.centre_px + 0.25 * area.size_px * Vec2(x, y), 0.5 * area.size_px, 0.0});
  if (windows.count == 0) return std::nullopt;  // a point on the image's edge
  return windows.items[static_cast<std::size_t>(look % windows.count)];
}

}  // namespace foretrack
