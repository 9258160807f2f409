// SPDX-License-Identifier: Apache-2.0
#include "core/perception/body_pose.hpp"

#include <gtest/gtest.h>

#include "core/perception/perceive.hpp"
#include "tests/core/perception/synthetic_person.hpp"

namespace foretrack {
namespace {

using test::LandmarkNoise;
using test::observe;
using test::PersonState;
using test::torso_of;
using test::vehicle_at;

const PerceptionParams kParams;

PersonState person_with_yaw(double yaw_rad) {
  PersonState person;
  person.hips_enu_m = {3.0, -2.0, 0.95};
  person.yaw_rad = yaw_rad;
  person.stride_rad = 0.8;
  return person;
}

// One measurement of a person by a level vehicle 1.4 m high at this distance and bearing.
PerceptionResult measure(const PersonState& person, double range_m, double bearing_rad,
                         const LandmarkNoise& noise, std::uint64_t seed,
                         const PerceptionParams& params = kParams) {
  Vec3 place = person.hips_enu_m;
  place.head<2>() += range_m * direction_of(bearing_rad);
  place.z() = 1.4;
  const VehicleState vehicle = vehicle_at(1.0, place, person.hips_enu_m);
  VehicleHistory history;
  history.add(vehicle);
  Random random(seed);
  PerceptionState state;
  return perceive(state, observe(person, vehicle, noise, random), history, params);
}

TEST(BodyPose, IsExactWithoutNoiseFromEverySide) {
  for (double range_m : {1.5, 2.0, 4.0, 8.0})
    for (double bearing = -3.0; bearing < 3.0; bearing += 0.7) {
      const PersonState person = person_with_yaw(0.4);
      const auto result = measure(person, range_m, bearing, LandmarkNoise::none(), 1);
      ASSERT_EQ(result.status, PerceptionStatus::kStarted);
      EXPECT_LT((result.measured.position_enu_m - torso_of(person)).norm(), 1e-4);
      EXPECT_NEAR(wrap_angle(result.measured.yaw_rad - 0.4), 0.0, 1e-4);
      EXPECT_LT(result.reprojection_rms_px, 1e-2);
    }
}

TEST(BodyPose, YawIsWhereTheChestPointsAtFourHeadings) {
  // The normal as the paper prints it would point to the back.
  for (double yaw : {0.0, kPi / 2.0, kPi, -kPi / 2.0})
    for (double bearing : {0.1, 1.7, -1.5, 3.0}) {
      const auto result = measure(person_with_yaw(yaw), 2.5, bearing, LandmarkNoise::none(), 1);
      EXPECT_NEAR(wrap_angle(result.measured.yaw_rad - yaw), 0.0, 1e-4);
    }
}

// A network's joints are wrong across the line of sight rather than its image points.
TEST(BodyPose, YawIsByWhereTheImageShowsTheShoulders) {
  for (double bearing = 0.1; bearing < 6.2; bearing += 0.4) {
    const PersonState person = person_with_yaw(0.4);
    const Vec3 place =
        person.hips_enu_m + Vec3(3.0 * std::cos(bearing), 3.0 * std::sin(bearing), 0.4);
    const VehicleState vehicle = vehicle_at(1.0, place, person.hips_enu_m);
    VehicleHistory history;
    history.add(vehicle);
    Random random(1);
    auto o = observe(person, vehicle, LandmarkNoise::none(), random);
    const double wrong_m = 0.05;
    o.landmarks[kLeftShoulder].body_m.x() += wrong_m;
    o.landmarks[kRightShoulder].body_m.x() -= wrong_m;
    PerceptionState state;
    const auto result = perceive(state, o, history, kParams);
    EXPECT_NEAR(wrap_angle(result.measured.yaw_rad - 0.4), 0.0, rad(2.0)) << bearing;
  }
}

TEST(BodyPose, IsWithinCentimetresWithNoise) {
  for (double range_m : {2.0, 3.0, 4.0}) {
    double squares = 0.0, yaw_squares = 0.0;
    for (int k = 0; k < 100; ++k) {
      const PersonState person = person_with_yaw(0.13 * k);
      const auto result = measure(person, range_m, 0.3 * k, LandmarkNoise(), k + 1);
      ASSERT_EQ(result.status, PerceptionStatus::kStarted);
      squares += (result.measured.position_enu_m - torso_of(person)).squaredNorm();
      const double yaw_error = wrap_angle(result.measured.yaw_rad - person.yaw_rad);
      if (std::isfinite(yaw_error)) yaw_squares += yaw_error * yaw_error;
    }
    EXPECT_LT(std::sqrt(squares / 100), 0.03 * range_m);
    EXPECT_LT(std::sqrt(yaw_squares / 100), rad(10.0));
  }
}

TEST(BodyPose, HoldsForAnyAttitudeAndMountOfTheCamera) {
  const PersonState person = person_with_yaw(1.0);
  CameraModel camera;
  camera.T_body_camera.linear() =
      Eigen::AngleAxisd(rad(10.0), Vec3::UnitY()) * camera.T_body_camera.linear();
  camera.T_body_camera.translation() = Vec3(0.12, 0.03, -0.05);
  VehicleState vehicle = vehicle_at(1.0, {0.5, -2.6, 1.6}, person.hips_enu_m);
  vehicle.q_world_body = vehicle.q_world_body * Quat(Eigen::AngleAxisd(0.15, Vec3::UnitX())) *
                         Quat(Eigen::AngleAxisd(-0.1, Vec3::UnitY()));
  VehicleHistory history;
  history.add(vehicle);
  Random random(1);
  PerceptionState state;
  const auto observation = observe(person, vehicle, LandmarkNoise::none(), random, camera);
  const auto result = perceive(state, observation, history, kParams);
  ASSERT_EQ(result.status, PerceptionStatus::kStarted);
  EXPECT_LT((result.measured.position_enu_m - torso_of(person)).norm(), 1e-4);
  EXPECT_NEAR(result.measured.yaw_rad, 1.0, 1e-4);
}

struct Scene {
  PersonState person = person_with_yaw(0.3);
  VehicleState vehicle = vehicle_at(0.0, {0.5, -2.0, 1.4}, {3.0, -2.0, 0.95});
  Vec3 torso_camera_m() const {
    return (vehicle.T_world_body() * CameraModel().T_body_camera).inverse() * torso_of(person);
  }
  static Vec3 torso_of_pose(const BodyPose& pose, const TargetObservation& o) {
    Vec3 sum = Vec3::Zero();
    for (const int k : {kLeftShoulder, kRightShoulder, kLeftHip, kRightHip})
      sum += pose.joint_camera_m(o.landmarks[k].body_m);
    return 0.25 * sum;
  }
};

TEST(BodyPose, IgnoresGrosslyWrongLandmarks) {
  const Scene scene;
  for (int seed = 1; seed <= 50; ++seed) {
    Random random(seed);
    auto o = observe(scene.person, scene.vehicle, LandmarkNoise(), random);
    std::array<bool, kLandmarkCount> wrong{};
    for (int k = 0; k < 10; ++k) {
      const int i = random.integer(0, kLandmarkCount - 1);
      const Vec2 before = o.landmarks[i].image_px;
      o.landmarks[i].image_px = {random.uniform(0, 640), random.uniform(0, 480)};
      wrong[i] = (o.landmarks[i].image_px - before).norm() > 60.0;
    }
    const auto pose = estimate_body_pose(o.landmarks, o.camera, kParams);
    ASSERT_TRUE(pose.has_value()) << seed;
    EXPECT_LT((scene.torso_of_pose(*pose, o) - scene.torso_camera_m()).norm(), 0.15) << seed;
    for (int i = 0; i < kLandmarkCount; ++i) EXPECT_FALSE(wrong[i] && pose->used[i]) << seed;
  }
}

TEST(BodyPose, ToleratesAxesThatAreNotQuiteTheCameras) {
  const Scene scene;
  for (const double tilt : {-0.35, -0.2, 0.2, 0.35})
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
      Random random(3);
      auto o = observe(scene.person, scene.vehicle, LandmarkNoise::none(), random);
      for (auto& l : o.landmarks) l.body_m = Eigen::AngleAxisd(tilt, axis) * l.body_m;
      const auto pose = estimate_body_pose(o.landmarks, o.camera, kParams);
      ASSERT_TRUE(pose.has_value());
      EXPECT_LT((scene.torso_of_pose(*pose, o) - scene.torso_camera_m()).norm(), 0.02);
    }
}

TEST(BodyPose, NeedsOnlyTheUpperBody) {
  const Scene scene;
  Random random(4);
  auto o = observe(scene.person, scene.vehicle, LandmarkNoise::none(), random);
  for (int k = kLeftHip; k < kLandmarkCount; ++k) {
    o.landmarks[k].visibility = 0.1;
    o.landmarks[k].image_px.setConstant(1e4);
  }
  const auto pose = estimate_body_pose(o.landmarks, o.camera, kParams);
  ASSERT_TRUE(pose.has_value());
  EXPECT_LT((scene.torso_of_pose(*pose, o) - scene.torso_camera_m()).norm(), 1e-3);
  EXPECT_EQ(pose->used_count, kLeftHip);
}

TEST(BodyPose, OfABodyThatTheImageCutsOffTheTorsoIsAsUnsureAsItSays) {
  const Scene scene;
  double squares_m2 = 0.0, said_m2 = 0.0;
  for (int seed = 1; seed <= 100; ++seed) {
    Random random(seed);
    auto o = observe(scene.person, scene.vehicle, LandmarkNoise(), random);
    const auto whole = estimate_body_pose(o.landmarks, o.camera, kParams);
    ASSERT_TRUE(whole.has_value());
    EXPECT_LT(whole->cut_off_covariance_m2.trace(), 1e-4);
    for (int k = kRightShoulder + 1; k < kLandmarkCount; ++k) o.landmarks[k].visibility = 0.1;
    const auto head = estimate_body_pose(o.landmarks, o.camera, kParams);
    if (!head) continue;
    squares_m2 += (scene.torso_of_pose(*head, o) - scene.torso_camera_m()).squaredNorm();
    said_m2 += head->cut_off_covariance_m2.trace();
  }
  EXPECT_GT(said_m2, 0.3 * squares_m2);
  EXPECT_LT(said_m2, 4.0 * squares_m2);
}

TEST(BodyPose, SaysWhenTheLandmarksAreNoisierThanStated) {
  const Scene scene;
  Random random(5);
  double stated = 0.0, doubled = 0.0;
  for (int k = 0; k < 50; ++k) {
    const auto a = observe(scene.person, scene.vehicle, {2.0, 0.03}, random);
    const auto b = observe(scene.person, scene.vehicle, {4.0, 0.06}, random);
    stated += estimate_body_pose(a.landmarks, a.camera, kParams)->noise_scale / 50;
    doubled += estimate_body_pose(b.landmarks, b.camera, kParams)->noise_scale / 50;
  }
  EXPECT_LT(stated, 1.2);
  EXPECT_NEAR(doubled, 2.0, 0.4);
}

TEST(BodyPose, HeightOfTheTargetScalesTheRange) {
  // A source that takes everybody for 1.70 m delivers this person's joints too small.
  const Scene scene;
  PerceptionParams params;
  params.target_height_m = 1.75;
  params.landmark_height_m = 1.70;
  Random random(6);
  auto o = observe(scene.person, scene.vehicle, LandmarkNoise::none(), random);
  for (auto& l : o.landmarks) l.body_m *= 1.70 / 1.75;
  const auto scaled = estimate_body_pose(o.landmarks, o.camera, params);
  const auto unscaled = estimate_body_pose(o.landmarks, o.camera, kParams);
  const double range_m = (scene.vehicle.position_enu_m - scene.person.hips_enu_m).norm();
  EXPECT_NEAR(scaled->T_camera_human.translation().norm(), range_m, 1e-3);
  EXPECT_NEAR(unscaled->T_camera_human.translation().norm(), range_m * 1.70 / 1.75, 1e-3);
}

TEST(BodyPose, IsNoneForImagePointsThatAreNoBody) {
  const Scene scene;
  Random random(7);
  for (int k = 0; k < 20; ++k) {
    auto o = observe(scene.person, scene.vehicle, LandmarkNoise(), random);
    for (auto& l : o.landmarks) l.image_px = {random.uniform(0, 640), random.uniform(0, 480)};
    const auto pose = estimate_body_pose(o.landmarks, o.camera, kParams);
    EXPECT_FALSE(pose.has_value()) << pose->used_count << " " << pose->noise_scale;
  }
}

}  // namespace
}  // namespace foretrack
