// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/landmark_camera.hpp"

#include <algorithm>

namespace foretrack {
namespace {

constexpr double kImagedFrom_m = 0.2;      // nearer to the image plane, nothing is imaged
constexpr double kPoorFactor = 5.0;        // noise of landmarks that are guessed
constexpr double kPositionNoise_m = 0.10;  // of observations that ignore the border
constexpr double kYawNoise_rad = 0.14;

// First-order Gauss–Markov noise beside white noise; both of unit variance in sum.
struct Mixture {
  double keep = 0.0, fresh = 1.0, lasting = 0.0, white = 1.0;
};

Mixture mixture_of(const LandmarkCameraParams& p, double dt_s) {
  const double keep = std::exp(-dt_s / p.correlation_s);
  return {keep, std::sqrt(1.0 - keep * keep), std::sqrt(p.correlated_share),
          std::sqrt(1.0 - p.correlated_share)};
}

template <class V>
V draw(Random& random) {
  V v;
  for (int i = 0; i < v.size(); ++i) v[i] = random.normal();
  return v;
}

LandmarkCamera::Noise next_noise(LandmarkCamera::Noise& lasting, const Mixture& m, Random& random) {
  lasting.image_px = m.keep * lasting.image_px + m.fresh * draw<Vec2>(random);
  lasting.joint_m = m.keep * lasting.joint_m + m.fresh * draw<Vec3>(random);
  return {m.lasting * lasting.image_px + m.white * draw<Vec2>(random),
          m.lasting * lasting.joint_m + m.white * draw<Vec3>(random)};
}

// A back looks much like a front: who mistakes it does so for some images in a row.
void draw_flip(LandmarkCamera& camera, double stamp_s) {
  constexpr double kSpell_s = 0.5;
  if (camera.params.flip_share <= 0.0 || stamp_s < camera.flips_until_s) return;
  camera.flips_until_s = stamp_s + kSpell_s;
  camera.flipped = camera.random.chance(camera.params.flip_share);
}

// Eyes are 1 to 3 and 4 to 6; from the ears on, left and right alternate.
void swap_sides(std::array<Landmark, kLandmarkCount>& landmarks) {
  for (int i = 1; i <= 3; ++i) std::swap(landmarks[i], landmarks[i + 3]);
  for (int i = 7; i + 1 < kLandmarkCount; i += 2) std::swap(landmarks[i], landmarks[i + 1]);
}

struct View {
  const World& world;
  Pose T_world_camera;
  Pose T_camera_world;
  bool sees(const Vec3& point_enu_m) const {
    return line_of_sight(world, T_world_camera.translation(), point_enu_m);
  }
};

View view_of(const World& world, const CameraModel& camera, const VehicleState& vehicle) {
  const Pose T_world_camera = vehicle.T_world_body() * camera.T_body_camera;
  return {world, T_world_camera, T_world_camera.inverse()};
}

// One landmark; true if it is seen.
bool image_landmark(const LandmarkCameraParams& p, const View& view, const Vec3& joint_enu_m,
                    const LandmarkCamera::Noise& noise, Random& random, Landmark& landmark) {
  const Vec3 in_camera = view.T_camera_world * joint_enu_m;
  const auto px =
      p.camera.project({in_camera.x(), in_camera.y(), std::max(in_camera.z(), kImagedFrom_m)});
  const bool seen = in_camera.z() > kImagedFrom_m && (!p.fov_gated || p.camera.contains(*px)) &&
                    view.sees(joint_enu_m);
  landmark.visibility = seen ? random.uniform(0.8, 1.0) : random.uniform(0.0, 0.3);
  const double poor = seen ? 1.0 : kPoorFactor;
  landmark.image_px = *px + poor * p.noise_px * noise.image_px;
  landmark.body_m += poor * p.joint_noise_m * noise.joint_m;
  return seen;
}

std::optional<TargetObservation> image_landmarks(LandmarkCamera& camera, const View& view,
                                                 const PersonState& person, double height_m,
                                                 double stamp_s) {
  const LandmarkCameraParams& p = camera.params;
  const auto joints = joints_enu_m(person, height_m);
  const Vec3 hips = 0.5 * (joints[kLeftHip] + joints[kRightHip]);
  const Mat3 scaled = p.landmark_height_m / height_m * view.T_camera_world.linear();
  const Mixture mixture = mixture_of(p, stamp_s - camera.last_image_s);
  camera.last_image_s = stamp_s;
  TargetObservation observation;
  observation.stamp_s = stamp_s;
  observation.camera = p.camera;
  int seen = 0;
  for (int i = 0; i < kLandmarkCount; ++i) {
    const auto noise = next_noise(camera.lasting[i], mixture, camera.random);
    observation.landmarks[i].body_m = scaled * (joints[i] - hips);
    seen += image_landmark(p, view, joints[i], noise, camera.random, observation.landmarks[i]);
  }
  if (seen < p.landmarks_needed) return std::nullopt;
  if (camera.flipped) swap_sides(observation.landmarks);
  return observation;
}

TargetObservation measure_position(LandmarkCamera& camera, const PersonState& person,
                                   double stamp_s) {
  TargetObservation observation;
  observation.stamp_s = stamp_s;
  observation.kind = TargetObservation::Kind::kPosition;
  observation.camera = camera.params.camera;
  observation.position_enu_m = person.position_enu_m + kPositionNoise_m * draw<Vec3>(camera.random);
  observation.covariance_m2 = kPositionNoise_m * kPositionNoise_m * Mat3::Identity();
  observation.body_yaw_rad = wrap_angle(
      person.body_yaw_rad + kYawNoise_rad * camera.random.normal() + (camera.flipped ? kPi : 0.0));
  observation.body_yaw_variance_rad2 = kYawNoise_rad * kYawNoise_rad;
  return observation;
}

bool any_body_point_seen(const View& view, const PersonState& person, double height_m) {
  const auto points = body_points_enu_m(person, height_m);
  return std::any_of(points.begin(), points.end(), [&](const Vec3& p) { return view.sees(p); });
}

std::optional<TargetObservation> take_image(LandmarkCamera& camera, const View& view,
                                            const PersonState& person, double height_m,
                                            double stamp_s) {
  const LandmarkCameraParams& p = camera.params;
  draw_flip(camera, stamp_s);
  if (camera.random.chance(p.dropout)) return std::nullopt;
  const Vec3 torso = view.T_camera_world * person.position_enu_m;
  if (torso.norm() > p.range_max_m || !any_body_point_seen(view, person, height_m))
    return std::nullopt;
  // Far to the side an image point runs away: beyond 80° a position is all there is.
  const bool imaged = torso.z() > torso.norm() * std::cos(rad(80.0));
  if (imaged) return image_landmarks(camera, view, person, height_m, stamp_s);
  if (p.fov_gated) return std::nullopt;
  return measure_position(camera, person, stamp_s);
}

}  // namespace

LandmarkCamera make_landmark_camera(const LandmarkCameraParams& params, std::uint64_t seed) {
  LandmarkCamera camera{.params = params, .random = Random(seed), .waiting = {}};
  for (auto& noise : camera.lasting) noise = {draw<Vec2>(camera.random), draw<Vec3>(camera.random)};
  return camera;
}

std::optional<TargetObservation> observe(LandmarkCamera& camera, const World& world,
                                         const VehicleState& vehicle, const PersonState& person,
                                         double height_m) {
  const double now_s = vehicle.stamp_s;
  if (now_s >= camera.next_image_s - 1e-9) {
    camera.next_image_s += 1.0 / camera.params.rate_hz;
    const View view = view_of(world, camera.params.camera, vehicle);
    if (auto image = take_image(camera, view, person, height_m, now_s))
      camera.waiting.push_back(std::move(*image));
  }
  if (camera.waiting.empty() ||
      now_s < camera.waiting.front().stamp_s + camera.params.delay_s - 1e-9)
    return std::nullopt;
  std::optional<TargetObservation> delivered(std::move(camera.waiting.front()));
  camera.waiting.erase(camera.waiting.begin());
  return delivered;
}

Sight sight_of(const World& world, const CameraModel& camera, const VehicleState& vehicle,
               const PersonState& person, double height_m, double range_max_m) {
  const View view = view_of(world, camera, vehicle);
  const Vec3 torso = view.T_camera_world * person.position_enu_m;
  const double azimuth = std::atan2(torso.x(), torso.z());
  const double elevation = std::atan2(-torso.y(), std::hypot(torso.x(), torso.z()));
  Sight sight;
  sight.in_view = std::abs(azimuth) <= 0.5 * camera.horizontal_fov_rad() &&
                  std::abs(elevation) <= 0.5 * camera.vertical_fov_rad() &&
                  torso.norm() <= range_max_m;
  int seen = 0;
  for (const Vec3& point : body_points_enu_m(person, height_m)) seen += view.sees(point);
  sight.unhidden = 2 * seen >= 5;
  return sight;
}

}  // namespace foretrack
