// SPDX-License-Identifier: Apache-2.0
// A world of boxes and what a depth camera sees of it, exactly.
#pragma once

#include <limits>
#include <vector>

#include "core/common/camera.hpp"
#include "core/common/vehicle.hpp"

namespace foretrack::test {

struct Box {
  Vec3 low, high;
  bool contains(const Vec3& p) const {
    return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
  }
};
using World = std::vector<Box>;

/// Distance along the direction to the first box (slab method); infinite if there is none.
inline double distance_along(const World& world, const Vec3& from, const Vec3& direction) {
  double first = std::numeric_limits<double>::infinity();
  for (const Box& box : world) {
    const Vec3 a = (box.low - from).cwiseQuotient(direction);
    const Vec3 b = (box.high - from).cwiseQuotient(direction);
    const double enter = a.cwiseMin(b).maxCoeff(), leave = a.cwiseMax(b).minCoeff();
    if (enter <= leave && enter >= 0.0) first = std::min(first, enter);
  }
  return first;
}

inline CameraModel small_camera() {
  return CameraModel::from_fov(160, 120, rad(90.0), rad(75.0));
}

inline DepthImage render(const World& world, const VehicleState& vehicle,
                         const CameraModel& camera = small_camera()) {
  DepthImage image;
  image.stamp_s = vehicle.stamp_s;
  image.camera = camera;
  image.depth_m.resize(static_cast<std::size_t>(camera.width_px) * camera.height_px);
  const Pose T = vehicle.T_world_body() * camera.T_body_camera;
  for (int v = 0; v < camera.height_px; ++v)
    for (int u = 0; u < camera.width_px; ++u) {
      const Vec3 ray((u + 0.5 - camera.cx_px) / camera.fx_px,
                     (v + 0.5 - camera.cy_px) / camera.fy_px, 1.0);
      // The ray's z is 1, so the distance along it is the depth.
      const double depth_m = distance_along(world, T.translation(), T.linear() * ray);
      image.depth_m[static_cast<std::size_t>(v) * camera.width_px + u] =
          static_cast<float>(depth_m);
    }
  return image;
}

inline VehicleState vehicle_at(double stamp_s, const Vec3& position, double yaw_rad = 0.0) {
  VehicleState v;
  v.stamp_s = stamp_s;
  v.position_enu_m = position;
  v.q_world_body = Quat(Eigen::AngleAxisd(yaw_rad, Vec3::UnitZ()));
  return v;
}

}  // namespace foretrack::test
