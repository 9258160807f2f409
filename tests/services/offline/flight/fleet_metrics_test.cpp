// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/fleet_metrics.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

// Two vehicles 3 m apart on both sides of the person, ten times a second.
std::vector<FleetRow> rows(int count) {
  std::vector<FleetRow> rows(count);
  for (int i = 0; i < count; ++i) {
    rows[i].now_s = 0.1 * (i + 1);
    rows[i].told_bytes = 200.0;
    rows[i].members.resize(2);
    for (int k = 0; k < 2; ++k) {
      FleetRowMember& m = rows[i].members[k];
      m.position_enu_m = {k == 0 ? -1.5 : 1.5, 0, 1.5};
      m.distance_m = 1.5;
      m.sees = true;
    }
    rows[i].members[0].is_near = true;
  }
  return rows;
}

TEST(FleetMetrics, OfAFlightThatGoesWell) {
  const auto m = fleet_metrics_of(rows(100), {}, {});
  EXPECT_EQ(m.vehicles, 2);
  EXPECT_EQ(m.union_visibility, 1.0);
  EXPECT_EQ(m.k2_visibility, 1.0);
  EXPECT_EQ(m.longest_unseen_s, 0.0);
  EXPECT_NEAR(m.min_separation_m, 2.5, 1e-9);
  EXPECT_EQ(m.below_separation_s, 0.0);
  EXPECT_EQ(m.contacts, 0);
  EXPECT_EQ(m.band_share, 1.0);
  EXPECT_NEAR(m.separation_score, 1.0, 1e-9);
  EXPECT_NEAR(m.bytes_per_s, 1000.0, 20.0);
  EXPECT_EQ(m.handovers, 0);
}

TEST(FleetMetrics, WhoIsUnseenIsUnseenByAllWhoAreThere) {
  auto r = rows(100);
  for (int i = 20; i < 60; ++i) r[i].members[0].sees = false;
  for (int i = 40; i < 50; ++i) r[i].members[1].sees = false;
  const TruthEvent turns[] = {{.begin_s = 4.5}, {.begin_s = 8.0}};
  auto m = fleet_metrics_of(r, turns, {});
  EXPECT_NEAR(m.union_visibility, 0.9, 1e-9);
  EXPECT_NEAR(m.k2_visibility, 0.6, 1e-9);
  EXPECT_NEAR(m.longest_unseen_s, 1.0, 1e-9);
  ASSERT_EQ(m.events.size(), 2U);
  EXPECT_NEAR(m.events[0].longest_unseen_s, 1.0, 1e-9);
  EXPECT_EQ(m.events[1].longest_unseen_s, 0.0);
  for (int i = 0; i < 100; ++i) r[i].members[1].there = i < 50;  // dies
  m = fleet_metrics_of(r, turns, {});
  EXPECT_NEAR(m.union_visibility, 0.8, 1e-9);
}

TEST(FleetMetrics, CountsContactsStacksAndHandovers) {
  auto r = rows(100);
  for (int i = 30; i < 40; ++i) r[i].members[1].position_enu_m = {-1.5, 0.0, 2.5};  // above
  for (int i = 60; i < 65; ++i) r[i].members[1].position_enu_m = {-1.2, 0.0, 1.5};
  for (int i = 50; i < 100; ++i) std::swap(r[i].members[0].is_near, r[i].members[1].is_near);
  const auto m = fleet_metrics_of(r, {}, {});
  EXPECT_EQ(m.contacts, 1);
  EXPECT_NEAR(m.min_separation_m, -0.2, 1e-9);
  EXPECT_NEAR(m.stacked_s, 1.5, 1e-9);
  EXPECT_NEAR(m.below_separation_s, 1.5, 1e-9);
  EXPECT_EQ(m.handovers, 1);
}

}  // namespace
}  // namespace foretrack
