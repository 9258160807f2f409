// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/person.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

constexpr double kStep_s = 0.01;

Person walker(const std::vector<Vec2>& route, PersonParams params = {}, double speed = 1.5) {
  return make_person(params, walk_along(route, {speed, 3.0, 0.45}), 0.0);
}

TEST(Person, StandsBeforeTheStartAndRestsAtTheEnd) {
  Person person = walker({{0, 0}, {3, 0}});
  while (person.state.stamp_s < 1.4) advance(person, kStep_s);
  EXPECT_EQ(person.state.position_enu_m.x(), 0.0);
  while (person.state.stamp_s < 8.0) advance(person, kStep_s);
  EXPECT_NEAR(person.state.position_enu_m.x(), 3.0, 1e-6);
  EXPECT_EQ(person.state.velocity_enu_m_s.norm(), 0.0);
  EXPECT_NEAR(person.state.body_yaw_rad, 0.0, 1e-9);
}

TEST(Person, StopsSuddenlyWithinTheAccelerationLimitAndWalksOn) {
  PersonParams params;
  params.stops = {{4.0, 2.0}};
  Person person = walker({{0, 0}, {20, 0}}, params, 2.0);
  while (person.state.stamp_s < 3.99) advance(person, kStep_s);
  EXPECT_NEAR(person.state.velocity_enu_m_s.x(), 2.0, 1e-9);
  const double at_m = person.state.position_enu_m.x();
  double greatest = 0.0;
  while (person.state.stamp_s < 5.0) {
    advance(person, kStep_s);
    greatest = std::max(greatest, person.state.acceleration_enu_m_s2.norm());
  }
  EXPECT_LE(greatest, 3.0 + 1e-6);
  EXPECT_EQ(person.state.velocity_enu_m_s.norm(), 0.0);
  EXPECT_NEAR(person.state.position_enu_m.x() - at_m, 4.0 / 6.0, 0.05);  // v²/2a
  while (person.state.stamp_s < 8.0) advance(person, kStep_s);
  EXPECT_NEAR(person.state.velocity_enu_m_s.x(), 2.0, 1e-9);
}

TEST(Person, WhoStepsBackKeepsTheChestWhereItWas) {
  const std::vector<Vec2> there_and_back = {{0, 0}, {4, 0}, {0, 0}};
  const Walk walk = walk_along(there_and_back, {});
  const double reversed_s = 0.5 * walk.duration_s();
  PersonParams params;
  params.backward = {{reversed_s, reversed_s + 1.0}};
  Person person = walker(there_and_back, params);
  double turned_rad = 0.0, back_m_s = 0.0;
  while (person.walked_s < reversed_s + 0.6) {
    advance(person, kStep_s);
    turned_rad = std::max(turned_rad, std::abs(person.state.body_yaw_rad));
    back_m_s = std::min(back_m_s, person.state.velocity_enu_m_s.x());
  }
  EXPECT_LT(turned_rad, rad(20.0));
  EXPECT_LT(back_m_s, -1.0);
  while (person.walked_s < reversed_s + 1.6) advance(person, kStep_s);
  EXPECT_NEAR(std::abs(person.state.body_yaw_rad), kPi, rad(5.0)) << "then they turn round";
}

TEST(Person, ShouldersTurnTheLeadBeforeThePath) {
  for (const double lead_s : {0.0, 0.3, 0.5}) {
    PersonParams params;
    params.shoulder_lead_s = lead_s;
    Person person = walker({{0, 0}, {6, 0}, {6, 6}}, params);
    double path_turns_s = 0.0, shoulders_turn_s = 0.0;
    while (person.state.stamp_s < 8.0) {
      advance(person, kStep_s);
      const Vec2 v = person.state.velocity_enu_m_s.head<2>();
      if (v.norm() > 0.2 && yaw_of(v) > rad(45) && path_turns_s == 0.0)
        path_turns_s = person.state.stamp_s;
      if (person.state.body_yaw_rad > rad(45) && shoulders_turn_s == 0.0)
        shoulders_turn_s = person.state.stamp_s;
    }
    EXPECT_NEAR(path_turns_s - shoulders_turn_s, lead_s, 0.03);
  }
}

TEST(Person, AChestMayFollowThePath) {
  PersonParams params;
  params.shoulder_lead_s = -0.2;
  Person person = walker({{0, 0}, {6, 0}, {6, 6}}, params);
  double path_turns_s = 0.0;
  while (person.state.body_yaw_rad < rad(45)) {
    advance(person, kStep_s);
    const Vec2 v = person.state.velocity_enu_m_s.head<2>();
    if (v.norm() > 0.2 && yaw_of(v) > rad(45) && path_turns_s == 0.0)
      path_turns_s = person.state.stamp_s;
    ASSERT_LT(person.state.stamp_s, 10.0);
  }
  EXPECT_NEAR(person.state.stamp_s - path_turns_s, 0.2, 0.03);
}

TEST(Person, AChestMayPointAsideAllTheWay) {
  PersonParams params;
  params.shoulder_lead_s = 0.0;
  params.shoulder_offset_rad = -2.8;
  Person person = walker({{0, 0}, {3, 0}, {3, 3}}, params);
  EXPECT_NEAR(person.state.body_yaw_rad, -2.8, 1e-9) << "before the first step, too";
  while (person.walked_s < person.walk.duration_s() - 0.3) {
    advance(person, kStep_s);
    const Vec2 v = person.state.velocity_enu_m_s.head<2>();
    if (v.norm() < 0.5) continue;
    EXPECT_LT(std::abs(wrap_angle(person.state.body_yaw_rad - yaw_of(v) + 2.8)), rad(12));
  }
}

TEST(Person, AChestMaySwayWhileItsPersonWalks) {
  PersonParams params;
  params.shoulder_sway_rad = 0.7;
  params.shoulder_sway_hz = 0.5;
  Person person = walker({{0, 0}, {12, 0}}, params);
  double least = 0.0, most = 0.0, last_crossing_s = 0.0, half_period_s = 0.0;
  while (person.state.stamp_s < 7.0) {
    const double before_rad = person.state.body_yaw_rad;
    advance(person, kStep_s);
    const double yaw_rad = person.state.body_yaw_rad;
    least = std::min(least, yaw_rad);
    most = std::max(most, yaw_rad);
    if (before_rad * yaw_rad >= 0.0) continue;
    half_period_s = person.state.stamp_s - last_crossing_s;
    last_crossing_s = person.state.stamp_s;
  }
  EXPECT_NEAR(least, -0.7, 0.01);
  EXPECT_NEAR(most, 0.7, 0.01);
  EXPECT_NEAR(half_period_s, 1.0, 0.05);
}

TEST(Person, VelocityIsTheDerivativeOfThePosition) {
  PersonParams params;
  params.stops = {{3.0, 1.0}};
  Person person = walker({{0, 0}, {6, 0}, {6, 6}}, params);
  Vec3 last = person.state.position_enu_m, last_velocity = Vec3::Zero();
  while (person.state.stamp_s < 9.0) {
    advance(person, kStep_s);
    const Vec3 mean = 0.5 * (last_velocity + person.state.velocity_enu_m_s);
    EXPECT_LT(((person.state.position_enu_m - last) / kStep_s - mean).norm(), 0.02);
    last = person.state.position_enu_m;
    last_velocity = person.state.velocity_enu_m_s;
  }
}

}  // namespace
}  // namespace foretrack
