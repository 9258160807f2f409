// SPDX-License-Identifier: Apache-2.0
#include "core/perception/expected_place.hpp"

namespace foretrack {
namespace {

constexpr double kSigmas = 3.0;
constexpr double kHalfBody_m = 0.5;
constexpr double kNowhere_px = -1e6;

}  // namespace

std::optional<ExpectedPlace> expected_place(const PerceptionState& state,
                                            const VehicleHistory& vehicle,
                                            const CameraModel& camera, double stamp_s,
                                            const PerceptionParams& params) {
  const TargetState target = coast(state, stamp_s, params);
  const auto at_image = vehicle.at(stamp_s);
  if (!target.usable() || !at_image) return std::nullopt;
  const Pose T_world_camera = at_image->T_world_body() * camera.T_body_camera;
  const Vec3 torso_camera_m = T_world_camera.inverse() * target.position_enu_m;
  const auto px = camera.project(torso_camera_m);
  const bool refused = state.entries[state.count - 1].estimate.verdict == FilterVerdict::kGated;
  if (!px) return ExpectedPlace{{kNowhere_px, kNowhere_px}, 0.0, 0.0, refused};
  const double sigma_m = std::sqrt(target.covariance.diagonal().head<3>().maxCoeff());
  const double px_per_m = camera.fx_px / torso_camera_m.z();
  return ExpectedPlace{*px, px_per_m * (kSigmas * sigma_m + kHalfBody_m),
                       px_per_m * params.target_height_m, refused, px_per_m * sigma_m};
}

}  // namespace foretrack
