// SPDX-License-Identifier: Apache-2.0
#include "services/convert/bodies.hpp"

#include "convert_test_support.hpp"

namespace foretrack {
namespace {

using testing::kInf;
using testing::kNaN;
using BodiesMsg = foretrack_msgs::msg::MovingBodies;
using SightingsMsg = foretrack_msgs::msg::BodySightings;

MovingBodies two_bodies() {
  MovingBodies bodies;
  bodies.stamp_s = 7.25;
  MovingBody person;
  person.id = 3;
  person.kind = BodyKind::kPerson;
  person.followed = true;
  person.position_enu_m = {1, 2, 0.1};
  person.velocity_enu_m_s = {1.5, -0.5, 0};
  person.position_covariance_m2 << 0.04, 0.01, 0.01, 0.09;
  person.velocity_covariance_m2_s2 << 0.25, 0, 0, 0.16;
  person.radius_m = 0.3;
  person.height_m = 1.8;
  person.step_s = 0.25;
  person.place_count = 2;
  person.places_enu_m[0] = {1.4, 1.9, 0.1};
  person.places_enu_m[1] = {1.8, 1.8, 0.1};
  bodies.add(person);
  MovingBody other;
  other.id = 4;
  other.position_enu_m = {4, 0, 0};
  bodies.add(other);
  return bodies;
}

BodySightings two_sightings() {
  BodySightings seen;
  seen.stamp_s = 7.25;
  seen.add({BodyKind::kPerson, {1, 2, 0}, 0.01 * Mat2::Identity(), 0.3, 1.8});
  seen.add({BodyKind::kUnknown, {3, 4, 0.2}, 0.04 * Mat2::Identity(), 0.5, 1.2});
  return seen;
}

BodiesMsg bodies_message() {
  BodiesMsg msg;
  to_idl(two_bodies(), {}, msg);
  return msg;
}
SightingsMsg sightings_message() {
  SightingsMsg msg;
  to_idl(two_sightings(), msg);
  return msg;
}

TEST(MovingBodiesMessage, RoundTrips) {
  const MovingBodies in = two_bodies();
  const auto out = from_idl(bodies_message());
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->stamp_s, in.stamp_s);
  ASSERT_EQ(out->count, in.count);
  for (int i = 0; i < in.count; ++i) {
    const MovingBody &a = in.bodies[i], &b = out->bodies[i];
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.followed, b.followed);
    EXPECT_EQ(b.stamp_s, in.stamp_s);
    EXPECT_EQ(a.position_enu_m, b.position_enu_m);
    EXPECT_EQ(a.velocity_enu_m_s, b.velocity_enu_m_s);
    EXPECT_EQ(a.position_covariance_m2, b.position_covariance_m2);
    EXPECT_EQ(a.velocity_covariance_m2_s2, b.velocity_covariance_m2_s2);
    EXPECT_EQ(a.radius_m, b.radius_m);
    EXPECT_EQ(a.height_m, b.height_m);
    EXPECT_EQ(a.step_s, b.step_s);
    ASSERT_EQ(a.place_count, b.place_count);
    for (int k = 0; k < a.place_count; ++k) EXPECT_EQ(a.places_enu_m[k], b.places_enu_m[k]);
  }
}

TEST(MovingBodiesMessage, ShowsWhatImagesShow) {
  std::array<PersonLook, 2> looks;
  looks[0].stamp_s = 7.0;
  looks[0].box_low_px = {10, 20};
  looks[0].box_high_px = {60, 200};
  looks[0].has_landmarks = true;
  looks[0].landmarks[11] = {{30, 40}, {0.1, 0.2, 0.3}, 0.9};
  looks[0].body_yaw_rad = 0.5;
  BodiesMsg msg;
  to_idl(two_bodies(), looks, msg);
  const auto &person = msg.bodies()[0], &other = msg.bodies()[1];
  EXPECT_NEAR(person.look_age_s(), 0.25, 1e-9);
  EXPECT_EQ(person.box_px(), (std::array<double, 4>{10, 20, 60, 200}));
  ASSERT_EQ(person.landmarks().size(), 33u);
  EXPECT_EQ(person.landmarks()[11].image_x_px(), 30.0F);
  EXPECT_EQ(person.landmarks()[11].body_z_m(), 0.3F);
  EXPECT_EQ(person.body_yaw_rad(), 0.5);
  EXPECT_TRUE(std::isnan(person.head_yaw_rad()));
  EXPECT_LT(other.look_age_s(), 0.0);
  EXPECT_TRUE(other.landmarks().empty());
}

TEST(MovingBodiesMessage, NobodyAroundIsAMessageToo) {
  BodiesMsg msg;
  to_idl(MovingBodies{}, {}, msg);
  const auto out = from_idl(msg);
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->count, 0);
}

TEST(MovingBodiesMessage, RefusesEachBadField) {
  using M = BodiesMsg;
  testing::expect_each_refused<M>(
      bodies_message(),
      testing::header_faults<M>() +
          std::vector<testing::PlantedFault<M>>{
              {"bodies", [](M& m) { m.bodies().resize(17); }},
              {"bodies.kind", [](M& m) { m.bodies()[1].kind(3); }},
              {"bodies.followed", [](M& m) { m.bodies()[1].followed(true); }},
              {"bodies.position_m", [](M& m) { m.bodies()[1].position_m()[2] = kNaN; }},
              {"bodies.velocity_mps", [](M& m) { m.bodies()[0].velocity_mps()[0] = 1e4; }},
              {"bodies.position_covariance_m2",
               [](M& m) { m.bodies()[0].position_covariance_m2()[0] = -1.0; }},
              {"bodies.velocity_covariance_m2_s2",
               [](M& m) { m.bodies()[0].velocity_covariance_m2_s2()[1] = kInf; }},
              {"bodies.radius_m", [](M& m) { m.bodies()[0].radius_m(0.0); }},
              {"bodies.height_m", [](M& m) { m.bodies()[1].height_m(kNaN); }},
              {"bodies.place_step_s", [](M& m) { m.bodies()[0].place_step_s(0.0); }},
              {"bodies.places_m", [](M& m) { m.bodies()[0].places_m().resize(17); }},
              {"bodies.places_m", [](M& m) { m.bodies()[0].places_m()[1].y(kNaN); }},
          },
      [](const M& m) { return from_idl(m); });
}

TEST(BodySightingsMessage, RoundTrips) {
  const BodySightings in = two_sightings();
  const auto out = from_idl(sightings_message());
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->stamp_s, in.stamp_s);
  ASSERT_EQ(out->count, in.count);
  for (int i = 0; i < in.count; ++i) {
    EXPECT_EQ(out->bodies[i].kind, in.bodies[i].kind);
    EXPECT_EQ(out->bodies[i].position_enu_m, in.bodies[i].position_enu_m);
    EXPECT_EQ(out->bodies[i].covariance_m2, in.bodies[i].covariance_m2);
    EXPECT_EQ(out->bodies[i].radius_m, in.bodies[i].radius_m);
    EXPECT_EQ(out->bodies[i].height_m, in.bodies[i].height_m);
  }
}

TEST(BodySightingsMessage, RefusesEachBadField) {
  using M = SightingsMsg;
  testing::expect_each_refused<M>(
      sightings_message(),
      testing::header_faults<M>() +
          std::vector<testing::PlantedFault<M>>{
              {"bodies", [](M& m) { m.bodies().resize(1000); }},
              {"bodies.kind", [](M& m) { m.bodies()[1].kind(200); }},
              {"bodies.position_m", [](M& m) { m.bodies()[0].position_m()[0] = kInf; }},
              {"bodies.covariance_m2", [](M& m) { m.bodies()[0].covariance_m2()[3] = kNaN; }},
              {"bodies.radius_m", [](M& m) { m.bodies()[0].radius_m(-0.3); }},
              {"bodies.height_m", [](M& m) { m.bodies()[0].height_m(100.0); }},
          },
      [](const M& m) { return from_idl(m); });
}

}  // namespace
}  // namespace foretrack
