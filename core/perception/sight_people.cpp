// SPDX-License-Identifier: Apache-2.0
#include "core/perception/sight_people.hpp"

#include <algorithm>

#include "core/perception/body_pose.hpp"
#include "core/perception/measure_height.hpp"

namespace foretrack {
namespace {

constexpr double kAdult_m = 1.75;
constexpr double kHeightSpread = 0.08;  // of people's heights, and so of ranges
constexpr double kBoxSpread = 0.15;     // of a range by the detector's box
constexpr double kLateralSigma_m = 0.1;
constexpr double kRadius_m = 0.25;
constexpr double kHipShare = 0.53;        // height of the hips over that of the person
constexpr double kBodyWidthShare = 0.35;  // of a box over its height
enum HeadJoint : int { kNose = 0, kLeftEar = 7, kRightEar = 8 };

Mat2 covariance_of(const Vec3& sight_m, double spread) {
  const double along_m = spread * sight_m.norm();
  const Vec2 direction = sight_m.head<2>().normalized();
  return kLateralSigma_m * kLateralSigma_m * Mat2::Identity() +
         along_m * along_m * direction * direction.transpose();
}

BodySighting person_at(const Vec3& foot_enu_m, const Vec3& eye_enu_m, double spread) {
  return {BodyKind::kPerson, foot_enu_m, covariance_of(foot_enu_m - eye_enu_m, spread), kRadius_m,
          kAdult_m};
}

bool is_seen(const Landmark& mark, const PerceptionParams& params) {
  return mark.visibility >= params.min_visibility;
}

void set_box(PersonLook& look, const PerceptionParams& params) {
  look.box_low_px = Vec2::Constant(1e9);
  look.box_high_px = Vec2::Constant(-1e9);
  for (const Landmark& mark : look.landmarks) {
    if (!is_seen(mark, params)) continue;
    look.box_low_px = look.box_low_px.cwiseMin(mark.image_px);
    look.box_high_px = look.box_high_px.cwiseMax(mark.image_px);
  }
}

// A quarter turn clockwise from right to left shoulder; from between the ears to the nose.
void set_yaws(PersonLook& look, const Mat3& R_world_human, const PerceptionParams& params) {
  const auto& marks = look.landmarks;
  const auto seen = [&](int k) { return is_seen(marks[k], params); };
  const auto yaw = [&](const Vec3& body_m) {
    return yaw_of(Vec2((R_world_human * body_m).head<2>()));
  };
  if (seen(kLeftShoulder) && seen(kRightShoulder))
    look.body_yaw_rad =
        wrap_angle(yaw(marks[kLeftShoulder].body_m - marks[kRightShoulder].body_m) - 0.5 * kPi);
  if (seen(kNose) && (seen(kLeftEar) || seen(kRightEar)))
    look.head_yaw_rad =
        yaw(marks[kNose].body_m - 0.5 * (marks[kLeftEar].body_m + marks[kRightEar].body_m));
}

PersonLook look_at(const TargetObservation& observation, const BodyPose& body,
                   const Pose& T_world_camera, const PerceptionParams& params) {
  PersonLook look;
  look.stamp_s = observation.stamp_s;
  look.has_landmarks = true;
  look.landmarks = observation.landmarks;
  set_box(look, params);
  set_yaws(look, T_world_camera.linear() * body.T_camera_human.linear(), params);
  look.height_m = measure_height(look.landmarks, observation.camera, T_world_camera,
                                 params.ground_m, params.min_visibility)
                      .value_or(PersonLook::kNaN);
  return look;
}

bool sight_by_landmarks(const PersonPose& pose, double stamp_s, const CameraModel& camera,
                        const Pose& T_world_camera, const PerceptionParams& params,
                        PeopleSeen& out) {
  const TargetObservation observation = to_observation(pose, stamp_s, camera, params);
  const auto body = estimate_body_pose(observation.landmarks, camera, params);
  if (!body) return false;
  Vec3 foot_enu_m = T_world_camera * torso_camera_m(*body, observation.landmarks, params);
  foot_enu_m.z() -= kTorsoShare * kAdult_m;
  if (!out.sightings.add(person_at(foot_enu_m, T_world_camera.translation(), kHeightSpread)))
    return true;
  out.looks[out.sightings.count - 1] = look_at(observation, *body, T_world_camera, params);
  return true;
}

// The detector's square is around the hips.
void sight_by_box(const ImageRegion& region, double stamp_s, const CameraModel& camera,
                  const Pose& T_world_camera, const PerceptionParams& params, PeopleSeen& out) {
  const double body_px = region.size_px / kRegionOverBody;
  const double depth_m = camera.fy_px * kAdult_m / std::max(body_px, 1.0);
  if (depth_m > params.max_range_m) return;
  const Vec2& hips_px = region.centre_px;
  Vec3 foot_enu_m =
      T_world_camera * Vec3(depth_m * (hips_px.x() - camera.cx_px) / camera.fx_px,
                            depth_m * (hips_px.y() - camera.cy_px) / camera.fy_px, depth_m);
  foot_enu_m.z() -= kHipShare * kAdult_m;
  if (!out.sightings.add(person_at(foot_enu_m, T_world_camera.translation(), kBoxSpread))) return;
  PersonLook& look = out.looks[out.sightings.count - 1] = {};
  look.stamp_s = stamp_s;
  const double half_px = 0.5 * kBodyWidthShare * body_px;
  look.box_low_px = hips_px - Vec2(half_px, (1.0 - kHipShare) * body_px);
  look.box_high_px = hips_px + Vec2(half_px, kHipShare * body_px);
}

}  // namespace

void sight_people(std::span<const OtherPerson> people, double stamp_s, const CameraModel& camera,
                  const VehicleHistory& vehicle, const PerceptionParams& params, PeopleSeen& out) {
  out.sightings.stamp_s = stamp_s;
  out.sightings.count = 0;
  const auto at_image = vehicle.at(stamp_s);
  if (!at_image) return;
  const Pose T_world_camera = at_image->T_world_body() * camera.T_body_camera;
  PerceptionParams adult = params;
  adult.target_height_m = kAdult_m;
  for (const OtherPerson& person : people) {
    const int before = out.sightings.count;
    if (!person.pose ||
        !sight_by_landmarks(*person.pose, stamp_s, camera, T_world_camera, adult, out))
      sight_by_box(person.region, stamp_s, camera, T_world_camera, adult, out);
    if (out.sightings.count > before) out.looks[out.sightings.count - 1].wear(person.wears);
  }
}

std::optional<PersonLook> look_of(const TargetObservation& observation,
                                  const VehicleHistory& vehicle, const PerceptionParams& params) {
  const auto at_image = vehicle.at(observation.stamp_s);
  const auto body = estimate_body_pose(observation.landmarks, observation.camera, params);
  if (!at_image || !body) return std::nullopt;
  return look_at(observation, *body, at_image->T_world_body() * observation.camera.T_body_camera,
                 params);
}

}  // namespace foretrack
