// SPDX-License-Identifier: Apache-2.0
#include "core/perception/sight_people.hpp"

#include <gtest/gtest.h>

#include "tests/core/perception/synthetic_person.hpp"

namespace foretrack {
namespace {

using test::LandmarkNoise;
using test::PersonState;
using test::vehicle_at;

/// A vehicle at the origin that sees somebody.
struct View {
  VehicleState vehicle = vehicle_at(5.0, {0, 0, 1.4}, {4, 0, 1.4});
  VehicleHistory history;
  CameraModel camera;
  PerceptionParams params;
  Random random{5};

  View() { history.add(vehicle); }
  TargetObservation observe(const PersonState& person,
                            const LandmarkNoise& noise = LandmarkNoise::none()) {
    return test::observe(person, vehicle, noise, random, camera);
  }
  // As the network gives it: axes of the viewing ray, the height of the network's people.
  PersonPose pose_of(const PersonState& person) {
    const TargetObservation o = observe(person);
    PersonPose pose;
    pose.landmarks = o.landmarks;
    pose.region.centre_px =
        0.5 * (o.landmarks[kLeftHip].image_px + o.landmarks[kRightHip].image_px);
    const Vec3 ray((pose.region.centre_px.x() - camera.cx_px) / camera.fx_px,
                   (pose.region.centre_px.y() - camera.cy_px) / camera.fy_px, 1.0);
    const Quat q_ray_camera = Quat::FromTwoVectors(Vec3::UnitZ(), ray).inverse();
    for (Landmark& mark : pose.landmarks)
      mark.body_m = kNetworkHeight_m / params.landmark_height_m * (q_ray_camera * mark.body_m);
    return pose;
  }
  PeopleSeen sight(const OtherPerson& person) {
    PeopleSeen seen;
    sight_people(std::span(&person, 1), vehicle.stamp_s, camera, history, params, seen);
    return seen;
  }
};

PersonState standing_at(double x, double y, double yaw_rad) {
  PersonState person;
  person.hips_enu_m = {x, y, 0.95};
  person.yaw_rad = yaw_rad;
  return person;
}

TEST(SightPeople, LandmarksSayWhereAPersonStands) {
  for (const double yaw_rad : {0.0, 1.5, 3.0, -2.0}) {
    View view;
    const PersonState person = standing_at(4.0, -1.0, yaw_rad);
    const PeopleSeen seen = view.sight({{}, view.pose_of(person)});
    ASSERT_EQ(seen.sightings.count, 1);
    const BodySighting& body = seen.sightings.bodies[0];
    EXPECT_EQ(body.kind, BodyKind::kPerson);
    EXPECT_EQ(seen.sightings.stamp_s, 5.0);
    const Vec2 off_m = body.position_enu_m.head<2>() - Vec2(4.0, -1.0);
    EXPECT_LT(off_m.norm(), 0.25);
    EXPECT_LT(off_m.dot(body.covariance_m2.inverse() * off_m), 4.0);
    EXPECT_NEAR(body.position_enu_m.z(), 0.0, 0.15);
    EXPECT_GT(body.covariance_m2(0, 0), body.covariance_m2(1, 1)) << "range is less certain";
  }
}

TEST(SightPeople, LooksShowBoxLandmarksAndWhereChestAndHeadPoint) {
  for (const double yaw_rad : {2.5, 3.1, -2.6, 1.8}) {
    View view;
    const PersonState person = standing_at(3.0, 0.5, yaw_rad);
    const PeopleSeen seen = view.sight({{}, view.pose_of(person)});
    ASSERT_EQ(seen.sightings.count, 1);
    const PersonLook& look = seen.looks[0];
    EXPECT_EQ(look.stamp_s, 5.0);
    EXPECT_TRUE(look.has_landmarks);
    EXPECT_NEAR(wrap_angle(look.body_yaw_rad - yaw_rad), 0.0, 0.15);
    EXPECT_NEAR(wrap_angle(look.head_yaw_rad - yaw_rad), 0.0, 0.15);
    for (const Landmark& mark : look.landmarks) {
      if (mark.visibility < 0.5) continue;
      EXPECT_TRUE((mark.image_px.array() >= look.box_low_px.array()).all());
      EXPECT_TRUE((mark.image_px.array() <= look.box_high_px.array()).all());
    }
  }
}

TEST(SightPeople, ABoxSaysItWithLessCertainty) {
  View view;
  const PersonState person = standing_at(5.0, 1.0, 0.0);
  const PersonPose pose = view.pose_of(person);
  const double body_px = view.camera.fy_px * 1.75 / 5.0;
  const PeopleSeen seen = view.sight({{pose.region.centre_px, 1.25 * body_px, 0.0}, {}});
  ASSERT_EQ(seen.sightings.count, 1);
  const BodySighting& body = seen.sightings.bodies[0];
  EXPECT_LT((body.position_enu_m.head<2>() - Vec2(5.0, 1.0)).norm(), 0.2);
  EXPECT_NEAR(body.position_enu_m.z(), 0.0, 0.1);
  EXPECT_GT(std::sqrt(body.covariance_m2(0, 0)), 0.5);
  EXPECT_FALSE(seen.looks[0].has_landmarks);
  EXPECT_TRUE(std::isnan(seen.looks[0].body_yaw_rad));
  EXPECT_NEAR(seen.looks[0].box_high_px.y() - seen.looks[0].box_low_px.y(), body_px, 1e-6);
}

TEST(SightPeople, NobodyIsPlacedWithoutThePoseOfTheVehicleOrTooFarAway) {
  View view;
  const OtherPerson tiny{{{320, 240}, 20.0, 0.0}, {}};
  EXPECT_EQ(view.sight(tiny).sightings.count, 0);
  view.history = VehicleHistory();
  EXPECT_EQ(view.sight({{{320, 240}, 200.0, 0.0}, {}}).sightings.count, 0);
}

TEST(SightPeople, MoreThanFitAreLeftOut) {
  View view;
  const std::vector<OtherPerson> crowd(20, OtherPerson{{{320, 240}, 200.0, 0.0}, {}});
  PeopleSeen seen;
  sight_people(crowd, 5.0, view.camera, view.history, view.params, seen);
  EXPECT_EQ(seen.sightings.count, BodySightings::kCapacity);
}

TEST(LookOf, ShowsTheFollowedPerson) {
  View view;
  const auto look = look_of(view.observe(standing_at(2.5, 0.0, 2.8)), view.history, view.params);
  ASSERT_TRUE(look);
  EXPECT_NEAR(wrap_angle(look->body_yaw_rad - 2.8), 0.0, 0.1);
  EXPECT_FALSE(look_of(view.observe(standing_at(2.5, 0.0, 2.8)), VehicleHistory(), view.params));
}

}  // namespace
}  // namespace foretrack
