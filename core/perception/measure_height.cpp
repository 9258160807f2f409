// SPDX-License-Identifier: Apache-2.0
#include "core/perception/measure_height.hpp"

#include <algorithm>

namespace foretrack {
namespace {

constexpr double kEarShare = 0.926;  // of the height (Drillis and Contini 1966)
constexpr double kFlattest = 0.12;   // slope of a ray to the ground: flatter ones are too long
constexpr double kLeast_m = 0.8, kMost_m = 2.3;  // of people on their feet
enum HeightJoint : int { kEarOfLeft = 7, kEarOfRight = 8, kHeelOfLeft = 29, kHeelOfRight = 30 };

Vec3 ray_of(const Vec2& px, const CameraModel& camera, const Pose& T_world_camera) {
  return T_world_camera.linear() *
         Vec3((px.x() - camera.cx_px) / camera.fx_px, (px.y() - camera.cy_px) / camera.fy_px, 1.0);
}

// Upwards over what it goes in the plane.
double slope_of(const Vec3& ray) {
  return ray.z() / std::max(ray.head<2>().norm(), 1e-9);
}

}  // namespace

std::optional<double> measure_height(const std::array<Landmark, kLandmarkCount>& landmarks,
                                     const CameraModel& camera, const Pose& T_world_camera,
                                     double ground_m, double min_visibility) {
  const auto seen = [&](int k) { return landmarks[k].visibility >= min_visibility; };
  const auto slope = [&](int k) {
    return slope_of(ray_of(landmarks[k].image_px, camera, T_world_camera));
  };
  if (!seen(kHeelOfLeft) || !seen(kHeelOfRight) || !seen(kEarOfLeft) || !seen(kEarOfRight))
    return std::nullopt;
  const double over_ground_m = T_world_camera.translation().z() - ground_m;
  const double down =
      -std::min(slope(kHeelOfLeft), slope(kHeelOfRight));  // who is lifted is farther
  if (over_ground_m <= 0.0 || down < kFlattest) return std::nullopt;
  const double away_m = over_ground_m / down;
  const double ear_m = over_ground_m + away_m * 0.5 * (slope(kEarOfLeft) + slope(kEarOfRight));
  const double height_m = ear_m / kEarShare;
  if (height_m < kLeast_m || height_m > kMost_m) return std::nullopt;
  return height_m;
}

}  // namespace foretrack
