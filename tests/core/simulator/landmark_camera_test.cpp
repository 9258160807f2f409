// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/landmark_camera.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

VehicleState vehicle_seeing_at(const Vec3& p, double yaw, double pitch = 0.0,
                               double stamp_s = 0.0) {
  VehicleState v;
  v.stamp_s = stamp_s;
  v.position_enu_m = p;
  v.q_world_body =
      Quat(Eigen::AngleAxisd(yaw, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch, Vec3::UnitY()));
  return v;
}
PersonState person_seen_at(double x, double y) {
  PersonState p;
  p.position_enu_m = {x, y, torso_height_m(1.75)};
  return p;
}
LandmarkCameraParams noiseless() {
  LandmarkCameraParams p;
  p.noise_px = p.joint_noise_m = p.delay_s = 0.0;
  return p;
}

TEST(LandmarkCamera, WithoutNoiseLandmarksAreTheProjectedJoints) {
  LandmarkCamera camera = make_landmark_camera(noiseless(), 1);
  const VehicleState vehicle = vehicle_seeing_at({0, 0, 1.5}, 0.2, 0.1);
  PersonState person = person_seen_at(2.5, 0.6);
  person.body_yaw_rad = 2.0;
  const auto observation = observe(camera, {}, vehicle, person, 1.75);
  ASSERT_TRUE(observation);
  const auto joints = joints_enu_m(person, 1.75);
  const Pose T_camera_world =
      (vehicle.T_world_body() * camera.params.camera.T_body_camera).inverse();
  const Vec3 hips = T_camera_world * Vec3(0.5 * (joints[kLeftHip] + joints[kRightHip]));
  for (int i = 0; i < kLandmarkCount; ++i) {
    const Landmark& landmark = observation->landmarks[i];
    if (landmark.visibility < 0.5) continue;
    const Vec3 in_camera = T_camera_world * joints[i];
    EXPECT_LT((landmark.image_px - *camera.params.camera.project(in_camera)).norm(), 1e-6);
    EXPECT_LT((landmark.body_m - (in_camera - hips)).norm(), 1e-9);
  }
}

TEST(LandmarkCamera, NoiseHasTheStatedSizeAndLasts) {
  auto params = noiseless();
  params.noise_px = 2.0;
  params.joint_noise_m = 0.03;
  params.correlated_share = 0.5;
  LandmarkCamera camera = make_landmark_camera(params, 3);
  LandmarkCamera clean = make_landmark_camera(noiseless(), 3);
  double square_px = 0.0, square_m = 0.0, lagged_px = 0.0, last = 0.0;
  const int n = 3000;
  for (int i = 0; i < n; ++i) {
    const auto vehicle = vehicle_seeing_at({0, 0, 1.5}, 0.0, 0.0, i / 30.0);
    const auto noisy = observe(camera, {}, vehicle, person_seen_at(3, 0), 1.75);
    const auto exact = observe(clean, {}, vehicle, person_seen_at(3, 0), 1.75);
    ASSERT_TRUE(noisy && exact);
    const double error = (noisy->landmarks[11].image_px - exact->landmarks[11].image_px).x();
    square_px += error * error / n;
    square_m += std::pow((noisy->landmarks[11].body_m - exact->landmarks[11].body_m).y(), 2) / n;
    lagged_px += error * last / n;
    last = error;
  }
  EXPECT_NEAR(std::sqrt(square_px), 2.0, 0.2);
  EXPECT_NEAR(std::sqrt(square_m), 0.03, 0.003);
  EXPECT_NEAR(lagged_px / square_px, 0.5 * std::exp(-1.0 / 30.0 / 0.3), 0.1);
}

TEST(LandmarkCamera, TakesLeftForRightForAsLongAsItIsTold) {
  const auto share_flipped = [](double flip_share, int& changes) {
    auto params = noiseless();
    params.flip_share = flip_share;
    LandmarkCamera camera = make_landmark_camera(params, 2);
    int flipped = 0, n = 1500;
    bool before = false;
    for (int i = 0; i < n; ++i) {
      const auto vehicle = vehicle_seeing_at({0, 0, 1.5}, 0.0, 0.0, i / 30.0);
      const auto seen = observe(camera, {}, vehicle, person_seen_at(3, 0), 1.75);
      EXPECT_TRUE(seen);
      // The person looks away from the camera: their left shoulder is on the image's left.
      const auto& marks = seen->landmarks;
      const bool now = marks[kLeftShoulder].image_px.x() > marks[kRightShoulder].image_px.x();
      EXPECT_EQ(now, marks[kLeftShoulder].body_m.x() > marks[kRightShoulder].body_m.x());
      EXPECT_EQ(now, marks[4].image_px.x() < marks[1].image_px.x()) << "the eyes, too";
      changes += now != before && i > 0;
      before = now;
      flipped += now;
    }
    return static_cast<double>(flipped) / n;
  };
  int changes = 0;
  EXPECT_EQ(share_flipped(0.0, changes), 0.0);
  EXPECT_EQ(share_flipped(1.0, changes), 1.0);
  EXPECT_EQ(changes, 0);
  EXPECT_NEAR(share_flipped(0.3, changes), 0.3, 0.1);
  EXPECT_LT(changes, 100) << "in spells, not image by image";
}

TEST(LandmarkCamera, DeliversLaterWithTheStampOfTheImage) {
  auto params = noiseless();
  params.delay_s = 0.05;
  LandmarkCamera camera = make_landmark_camera(params, 1);
  int delivered = 0;
  for (int i = 0; i <= 300; ++i) {
    const auto vehicle = vehicle_seeing_at({0, 0, 1.5}, 0.0, 0.0, 0.01 * i);
    const auto observation = observe(camera, {}, vehicle, person_seen_at(3, 0), 1.75);
    if (!observation) continue;
    ++delivered;
    EXPECT_NEAR(vehicle.stamp_s - observation->stamp_s, 0.05, 1e-9);
  }
  EXPECT_NEAR(delivered, 89, 2);  // 30 Hz
}

TEST(LandmarkCamera, DropsTheStatedShareOfImages) {
  auto params = noiseless();
  params.dropout = 0.3;
  LandmarkCamera camera = make_landmark_camera(params, 1);
  int seen = 0;
  for (int i = 0; i < 2000; ++i)
    seen += observe(camera, {}, vehicle_seeing_at({0, 0, 1.5}, 0, 0, i / 30.0),
                    person_seen_at(3, 0), 1.75)
                .has_value();
  EXPECT_NEAR(seen / 2000.0, 0.7, 0.03);
}

TEST(LandmarkCamera, HidesWhatTheWorldHidesLandmarkByLandmark) {
  World world;
  world.boxes.push_back({{1.4, -2, 0}, {1.6, 2, 1.0}});  // hides the legs alone
  LandmarkCamera camera = make_landmark_camera(noiseless(), 1);
  const auto observation =
      observe(camera, world, vehicle_seeing_at({0, 0, 1.5}, 0), person_seen_at(3, 0), 1.75);
  ASSERT_TRUE(observation);
  EXPECT_GT(observation->landmarks[kLeftShoulder].visibility, 0.7);
  EXPECT_LT(observation->landmarks[27].visibility, 0.4);
  world.boxes[0].max_m.z() = 3.0;
  LandmarkCamera blind = make_landmark_camera(noiseless(), 1);
  EXPECT_FALSE(
      observe(blind, world, vehicle_seeing_at({0, 0, 1.5}, 0), person_seen_at(3, 0), 1.75));
}

TEST(LandmarkCamera, SeesNothingOutsideItsViewUnlessUngated) {
  LandmarkCamera gated = make_landmark_camera(noiseless(), 1);
  EXPECT_FALSE(observe(gated, {}, vehicle_seeing_at({0, 0, 1.5}, kPi), person_seen_at(3, 0), 1.75));
  auto params = noiseless();
  params.fov_gated = false;
  LandmarkCamera free = make_landmark_camera(params, 1);
  const auto behind =
      observe(free, {}, vehicle_seeing_at({0, 0, 1.5}, kPi), person_seen_at(3, 0), 1.75);
  ASSERT_TRUE(behind);
  EXPECT_EQ(behind->kind, TargetObservation::Kind::kPosition);
  EXPECT_LT((behind->position_enu_m - person_seen_at(3, 0).position_enu_m).norm(), 0.6);
}

TEST(SightOf, ViewEndsAtTheAnglesOfTheCamera) {
  const CameraModel camera;
  const PersonState person = person_seen_at(3, 0);
  const double z = person.position_enu_m.z();
  const auto in_view = [&](double yaw, double pitch) {
    return sight_of({}, camera, vehicle_seeing_at({0, 0, z}, yaw, pitch), person, 1.75, 8.0)
        .in_view;
  };
  EXPECT_TRUE(in_view(rad(44), 0));
  EXPECT_FALSE(in_view(rad(46), 0));
  EXPECT_TRUE(in_view(0, rad(37)));
  EXPECT_FALSE(in_view(0, rad(38)));
  EXPECT_FALSE(sight_of({}, camera, vehicle_seeing_at({0, 0, z}, 0), person, 1.75, 2.9).in_view);
}

TEST(SightOf, NeedsHalfOfTheBodyPoints) {
  World world;
  world.boxes.push_back({{1.4, -2, 0}, {1.6, 2, 0}});
  const auto unhidden = [&](double height) {
    world.boxes[0].max_m.z() = height;
    return sight_of(world, {}, vehicle_seeing_at({0, 0, 1.5}, 0), person_seen_at(3, 0), 1.75, 8.0)
        .unhidden;
  };
  EXPECT_TRUE(unhidden(1.2));   // hip and knee hidden
  EXPECT_FALSE(unhidden(1.5));  // shoulders as well
}

}  // namespace
}  // namespace foretrack
