// SPDX-License-Identifier: Apache-2.0
#include "core/perception/torso_depth.hpp"

#include <algorithm>
#include <array>

#include "core/perception/torso_points.hpp"

namespace foretrack {
namespace {

constexpr int kSteps = 9;          // samples a side
constexpr double kLeftOut = 0.22;  // of the torso, at each side
constexpr float kNearest_m = 0.2f;
constexpr float kFarthest_m = 30.0f;
constexpr int kLeastReturns = kSteps * kSteps / 4;

}  // namespace

std::optional<double> torso_surface_depth_m(const TargetObservation& observation,
                                            const DepthImage& depth) {
  const CameraModel &colour = observation.camera, &camera = depth.camera;
  std::array<float, kSteps * kSteps> returns;
  int count = 0;
  visit_torso(observation.landmarks, kSteps, kLeftOut, [&](const Vec2& at, int) {
    const Vec2 px((at.x() - colour.cx_px) / colour.fx_px * camera.fx_px + camera.cx_px,
                  (at.y() - colour.cy_px) / colour.fy_px * camera.fy_px + camera.cy_px);
    if (!camera.contains(px)) return;
    const auto k = static_cast<std::size_t>(px.y()) * static_cast<std::size_t>(camera.width_px) +
                   static_cast<std::size_t>(px.x());
    const float z = k < depth.depth_m.size() ? depth.depth_m[k] : 0.0f;
    if (z > kNearest_m && z < kFarthest_m) returns[count++] = z;
  });
  if (count < kLeastReturns) return std::nullopt;
  std::nth_element(returns.begin(), returns.begin() + count / 2, returns.begin() + count);
  return returns[count / 2];
}

}  // namespace foretrack
