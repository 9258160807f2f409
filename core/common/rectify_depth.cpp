// SPDX-License-Identifier: Apache-2.0
#include "core/common/rectify_depth.hpp"

#include <cmath>

namespace foretrack {
namespace {

constexpr double kSameRay = 1e-4;  // at z = 1

}  // namespace

PixelMap straightening(const CameraWithLens& c) {
  PixelMap map;
  map.reserve(static_cast<std::size_t>(c.camera.width_px) * c.camera.height_px);
  for (int row = 0; row < c.camera.height_px; ++row)
    for (int column = 0; column < c.camera.width_px; ++column) {
      const Vec2 straight(column + 0.5, row + 0.5);
      const Vec2 ray((straight.x() - c.camera.cx_px) / c.camera.fx_px,
                     (straight.y() - c.camera.cy_px) / c.camera.fy_px);
      const Vec2 bent = distort(ray, c.camera, c.lens);
      std::int32_t source = -1;
      // Past the fold of the polynomial a ray would end in a pixel that is another one's.
      if (bent.allFinite() && c.camera.contains(bent)) {
        const auto back = undistort(bent, c.camera, c.lens);
        const double most = kSameRay * c.camera.fx_px;
        if (back && (*back - straight).norm() < most)
          source = static_cast<std::int32_t>(bent.y()) * c.camera.width_px +
                   static_cast<std::int32_t>(bent.x());
      }
      map.push_back(source);
    }
  return map;
}

void rectify_depth(const PixelMap& map, const std::vector<float>& distorted,
                   std::vector<float>& straight) {
  straight.resize(map.size());
  for (std::size_t i = 0; i < map.size(); ++i)
    straight[i] = map[i] < 0 ? 0.0F : distorted[static_cast<std::size_t>(map[i])];
}

}  // namespace foretrack
