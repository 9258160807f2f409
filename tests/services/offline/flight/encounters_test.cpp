// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/encounters.hpp"

#include <gtest/gtest.h>

#include "services/offline/flight/people_metrics.hpp"

namespace foretrack {
namespace {

constexpr double kStep_s = 0.01;

// A vehicle that hovers at the origin, 1.2 m high, 2 m behind somebody who stands; a bystander
// comes along x towards it at 1 m/s, `aside_m` beside it, and goes on.
std::vector<FlightRow> passed_by(double aside_m, double for_s = 12.0) {
  std::vector<FlightRow> rows;
  for (int i = 1; i <= std::lround(for_s / kStep_s); ++i) {
    FlightRow r;
    r.now_s = i * kStep_s;
    r.vehicle.position_enu_m = {0, 0, 1.2};
    r.target.position_enu_m = {2, 0, torso_height_m(1.75)};
    r.sight = {true, true};
    r.clearance_m = 3.0;
    r.bystanders = {{{6.0 - r.now_s, aside_m, 0.0}, {-1.0, 0.0, 0.0}, 1.75, r.now_s < 6.0}};
    rows.push_back(r);
  }
  return rows;
}

TEST(Encounters, OneBeginsWhenTheCourseLeadsWithinReachAndEndsWhenItNoLongerDoes) {
  const auto found = encounters_of(passed_by(1.0), {});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].person, 1);
  // √(1.5² − 1) before the vehicle after 4 s.
  EXPECT_NEAR(found[0].begin_s, 6.0 - 4.0 - std::sqrt(1.25), 0.02);
  EXPECT_GT(found[0].end_s, 6.5);
  EXPECT_LT(found[0].end_s, 7.5);
  EXPECT_NEAR(found[0].least_gap_m, 1.0 - 0.5, 1e-6);
  EXPECT_NEAR(found[0].least_gap_s, 6.0, 0.02);
  EXPECT_NEAR(found[0].person_speed_m_s, 1.0, 1e-9);
  EXPECT_TRUE(found[0].seen);
  EXPECT_FALSE(found[0].contact());
  EXPECT_EQ(found[0].evasion, Evasion::kStayed);
}

TEST(Encounters, APassFurtherOffAndAFollowerAreNone) {
  EXPECT_TRUE(encounters_of(passed_by(1.6), {}).empty());
  auto rows = passed_by(3.0);
  for (FlightRow& r : rows) {  // follows at the person's own speed, with a wobble
    r.target.position_enu_m.x() = 2.0 + r.now_s;
    r.target.velocity_enu_m_s.x() = 1.0;
    r.vehicle.position_enu_m.x() = r.now_s;
    r.vehicle.velocity_enu_m_s.x() = 1.0 + 0.2 * std::sin(r.now_s);
  }
  EXPECT_TRUE(encounters_of(rows, {}).empty());
}

TEST(Encounters, ContactIsOneWithinTheHulls) {
  auto rows = passed_by(0.4);
  const auto touched = encounters_of(rows, {});
  EXPECT_TRUE(touched.at(0).contact());
  for (FlightRow& r : rows) r.vehicle.position_enu_m.z() = 2.3;  // above the head
  const auto above = encounters_of(rows, {});
  EXPECT_FALSE(above.at(0).contact());
  EXPECT_NEAR(above.at(0).least_gap_m, std::hypot(0.15, 2.3 - 1.75) - 0.25, 1e-6);
}

TEST(Encounters, SaysWhichWayTheVehicleWent) {
  const auto way = [](const Vec3& velocity) {
    auto rows = passed_by(0.2);
    for (FlightRow& r : rows)
      if (r.now_s > 3.0) r.vehicle.position_enu_m += std::min(r.now_s - 3.0, 2.0) * velocity;
    return encounters_of(rows, {}).at(0).evasion;
  };
  EXPECT_EQ(way({-0.3, 0.0, 0.0}), Evasion::kBack);
  EXPECT_EQ(way({0.0, 0.3, 0.0}), Evasion::kAside);
  EXPECT_EQ(way({-0.1, 0.1, 0.3}), Evasion::kUp);
  EXPECT_EQ(way({0.0, 0.0, 0.0}), Evasion::kStayed);
  EXPECT_EQ(way({0.3, 0.0, 0.0}), Evasion::kStayed) << "towards the person";
}

TEST(Encounters, LossOfViewCountsButNotWhileItEvadesUpward) {
  auto rows = passed_by(0.5);
  for (FlightRow& r : rows) r.sight.unhidden = r.now_s < 5.0 || r.now_s > 5.8;
  EXPECT_NEAR(encounters_of(rows, {}).at(0).longest_loss_s, 0.8, 0.02);
  for (FlightRow& r : rows)
    if (r.now_s > 5.3 && r.now_s < 6.3) r.vehicle.position_enu_m.z() = 2.4;
  const auto evading = encounters_of(rows, {});
  EXPECT_NEAR(evading.at(0).longest_loss_s, 0.3, 0.03);
  EXPECT_NEAR(evading.at(0).evading_s, 1.0, 0.03);
}

TEST(Encounters, TheFloorFallsWithThePersonsSpeed) {
  EXPECT_EQ(gap_floor_m(0.5), 0.5);
  EXPECT_EQ(gap_floor_m(1.5), 0.5);
  EXPECT_EQ(gap_floor_m(2.0), 0.3);
  EXPECT_EQ(gap_floor_m(3.0), 0.0);
}

TEST(Hover, IsToStandFarFromTheFollowedPersonWithNobodyInTheWay) {
  auto rows = passed_by(8.0);
  EXPECT_EQ(longest_hover_s(rows, {}), 0.0);
  for (FlightRow& r : rows)
    if (r.now_s > 3.0) r.target.position_enu_m.x() = 4.0;
  EXPECT_NEAR(longest_hover_s(rows, {}), 9.0, 0.02);
  for (FlightRow& r : rows)
    if (r.now_s > 5.0) r.bystanders[0].foot_enu_m = {1.2, 0.0, 0.0};
  EXPECT_NEAR(longest_hover_s(rows, {}), 2.0, 0.02);
}

TEST(PeopleMetrics, CountContactsAndLeastGapsApart) {
  auto rows = passed_by(0.3);
  const Metrics m = metrics_of(rows, {});
  EXPECT_EQ(m.bystander_contacts, 1);
  EXPECT_NEAR(m.min_bystander_gap_m, 0.3 - 0.5, 1e-6);
  EXPECT_EQ(m.person_contacts, 0);
  EXPECT_NEAR(m.min_person_gap_m, 1.5, 1e-6);
  for (FlightRow& r : rows) {
    r.bystanders.clear();
    if (r.now_s > 4.0 && r.now_s < 4.5) r.target.position_enu_m.x() = 0.2;
    if (r.now_s > 6.0 && r.now_s < 6.5) r.target.position_enu_m.x() = -0.2;
  }
  const Metrics alone = metrics_of(rows, {});
  EXPECT_EQ(alone.person_contacts, 2);
  EXPECT_EQ(alone.bystander_contacts, 0);
  EXPECT_TRUE(std::isinf(alone.min_bystander_gap_m));
}

TEST(PeopleMetrics, EvadingUpwardIsToldApart) {
  auto rows = passed_by(6.0, 10.0);
  for (FlightRow& r : rows) {
    if (r.now_s <= 2.0) continue;
    r.sight.in_view = r.now_s > 4.0;
    r.target.position_enu_m.x() = r.now_s > 4.0 ? 2.0 : 0.5;
    if (r.now_s <= 3.0) r.vehicle.position_enu_m.z() = 2.6;
  }
  const Metrics m = metrics_of(rows, {});
  EXPECT_NEAR(m.failure_rate, 0.2, 1e-3);
  EXPECT_NEAR(m.evading_s, 1.0, 0.02);
  EXPECT_NEAR(m.failure_rate_not_evading, 1.0 / 9.0, 2e-3);
  EXPECT_NEAR(m.near_rate_not_evading, 1.0 / 9.0, 2e-3);
  EXPECT_NEAR(m.unseen_rate_not_evading, 1.0 / 9.0, 2e-3);
}

}  // namespace
}  // namespace foretrack
