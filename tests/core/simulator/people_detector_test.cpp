// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/people_detector.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

Person detected_at(double x, double y) {
  BystanderSpec spec;
  spec.route_m = {{x, y}};
  return make_bystander(spec, 0.0, 1.0);
}

VehicleState vehicle_at(double stamp_s) {
  VehicleState v;
  v.stamp_s = stamp_s;
  v.position_enu_m = {0, 0, 1.4};
  return v;
}

Cylinder nobody() {
  return {{-50, 0}, kPersonRadius_m, 1.75, 0.0};
}

PeopleDetectorParams prompt() {
  PeopleDetectorParams p;
  p.dropout = p.delay_s = 0.0;
  return p;
}

int seen(const World& world, const std::vector<Person>& people, const Cylinder& followed) {
  PeopleDetector detector = make_people_detector(prompt(), 1);
  return detect(detector, world, vehicle_at(0.0), people, followed)->count;
}

TEST(PeopleDetector, SeesWhoIsInTheImageAndHiddenByNobody) {
  World wall;
  wall.boxes = {{{1.0, -1.0, 0.0}, {1.2, 1.0, 3.0}}};
  EXPECT_EQ(seen({}, {detected_at(4, 0), detected_at(3, 2)}, nobody()), 2);
  EXPECT_EQ(seen({}, {detected_at(-4, 0), detected_at(1, 3), detected_at(9, 0)}, nobody()), 0);
  EXPECT_EQ(seen(wall, {detected_at(4, 0)}, nobody()), 0);
  EXPECT_EQ(seen({}, {detected_at(4, 0), detected_at(2, 0)}, nobody()), 1) << "one hides the other";
  EXPECT_EQ(seen({}, {detected_at(4, 0)}, {{2, 0}, kPersonRadius_m, 1.75, 0.0}), 0);
}

TEST(PeopleDetector, ErrorsHaveTheCovarianceThatItSays) {
  PeopleDetector detector = make_people_detector(prompt(), 7);
  const std::vector<Person> people = {detected_at(4.0, 2.0)};
  double sum = 0.0;
  const int n = 4000;
  for (int i = 0; i < n; ++i) {
    const auto look = detect(detector, {}, vehicle_at(0.1 * i), people, nobody());
    ASSERT_TRUE(look);
    ASSERT_EQ(look->count, 1);
    const BodySighting& s = look->bodies[0];
    EXPECT_EQ(s.kind, BodyKind::kPerson);
    const Vec2 error = s.position_enu_m.head<2>() - Vec2(4.0, 2.0);
    sum += error.dot(s.covariance_m2.inverse() * error) / n;
    EXPECT_NEAR(s.position_enu_m.z(), 0.0, 1e-9);
  }
  EXPECT_NEAR(sum, 2.0, 0.15);  // degrees of freedom
}

TEST(PeopleDetector, DeliversLaterWithTheStampOfTheImageAlsoWhereNobodyIs) {
  PeopleDetectorParams params = prompt();
  params.delay_s = 0.05;
  PeopleDetector detector = make_people_detector(params, 1);
  int looks = 0;
  for (int i = 0; i <= 100; ++i) {
    const double now_s = 0.01 * i;
    const auto look = detect(detector, {}, vehicle_at(now_s), {}, nobody());
    if (!look) continue;
    ++looks;
    EXPECT_EQ(look->count, 0);
    EXPECT_NEAR(now_s - look->stamp_s, 0.05, 1e-9);
  }
  EXPECT_EQ(looks, 10);
}

TEST(PeopleDetector, MissesTheStatedShare) {
  PeopleDetectorParams params = prompt();
  params.dropout = 0.25;
  PeopleDetector detector = make_people_detector(params, 3);
  const std::vector<Person> people = {detected_at(3, 0)};
  int count = 0;
  for (int i = 0; i < 2000; ++i)
    count += detect(detector, {}, vehicle_at(0.1 * i), people, nobody())->count;
  EXPECT_NEAR(count / 2000.0, 0.75, 0.03);
}

}  // namespace
}  // namespace foretrack
