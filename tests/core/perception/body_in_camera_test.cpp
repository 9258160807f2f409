// SPDX-License-Identifier: Apache-2.0
#include "core/perception/body_in_camera.hpp"

#include <gtest/gtest.h>

#include "tests/core/perception/synthetic_person.hpp"

namespace foretrack {
namespace {

// As the network would see somebody of that height: joints of a person of its height.
PersonPose seen(const test::PersonState& person, const VehicleState& vehicle, double height_m) {
  Random random(1);
  PersonPose pose;
  const auto observation = test::observe(person, vehicle, test::LandmarkNoise::none(), random);
  pose.landmarks = observation.landmarks;
  for (Landmark& landmark : pose.landmarks) landmark.body_m *= kNetworkHeight_m / height_m;
  pose.region.centre_px = {observation.camera.cx_px, observation.camera.cy_px};
  return pose;
}

TEST(LocateBody, FindsTorsoAndYawAtEveryHeading) {
  PerceptionParams params;
  params.target_height_m = 1.75;  // of the synthetic person
  const VehicleState vehicle = test::vehicle_at(0.0, {0.0, 0.0, 1.2}, {3.0, 1.0, 1.2});
  const CameraModel camera;
  const Pose T_camera_world = (vehicle.T_world_body() * camera.T_body_camera).inverse();
  for (double yaw = -3.0; yaw <= 3.0; yaw += 0.5) {
    test::PersonState person;
    person.hips_enu_m = {3.0, 1.0, 0.95};
    person.yaw_rad = yaw;
    const auto body = locate_body(seen(person, vehicle, 1.75), camera, params);
    ASSERT_TRUE(body) << yaw;
    EXPECT_LT((body->torso_camera_m - T_camera_world * test::torso_of(person)).norm(), 0.01);
    EXPECT_NEAR(wrap_angle(body->yaw_rad - (yaw - vehicle.yaw_rad())), 0.0, 0.02);
  }
}

TEST(LocateBody, WhoFacesTheCameraHasAYawOfHalfATurn) {
  test::PersonState person;
  person.hips_enu_m = {3.0, 0.0, 0.95};
  person.yaw_rad = kPi;
  const auto vehicle = test::vehicle_at(0.0, {0.0, 0.0, 1.2}, {3.0, 0.0, 1.2});
  const auto body = locate_body(seen(person, vehicle, 1.75), {}, {});
  ASSERT_TRUE(body);
  EXPECT_NEAR(std::abs(body->yaw_rad), kPi, 0.02);
}

TEST(LocateBody, WithoutVisibleLandmarksThereIsNoPlace) {
  EXPECT_FALSE(locate_body(PersonPose{}, {}, {}));
}

}  // namespace
}  // namespace foretrack
