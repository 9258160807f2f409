// SPDX-License-Identifier: Apache-2.0
#include "core/fleet/peer_body.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

FleetMember hovering_at(const Vec3& place, double stamp_s = 10.0) {
  FleetMember m;
  m.vehicle = "uav2";
  m.stamp_s = stamp_s;
  m.position_enu_m = place;
  return m;
}

constexpr double kHull_m = 0.25, kGap_m = 0.5;

// As near as the planner may come to the body's centre.
double nearest_m(const MovingBody& body) {
  return body.radius_m + kGap_m + kHull_m;
}

TEST(PeerBody, WhoKeepsItsGapFromItKeepsTheSeparation) {
  const FleetParams params;
  const PeerView view{.now_s = 10.0, .own_enu_m = {20, 0, 1.5}, .gap_min_m = kGap_m};
  const MovingBody body = peer_body(hovering_at({0, 0, 1.5}), view, params);
  EXPECT_EQ(body.kind, BodyKind::kVehicle);
  EXPECT_NEAR(nearest_m(body) - 2.0 * kHull_m, params.separation_m + params.margin_m, 1e-9);
  EXPECT_LE(body.position_enu_m.z(), 1.5 - params.downwash_m + 1e-9);
  EXPECT_GE(body.position_enu_m.z() + body.height_m, 1.5 + params.downwash_m - 1e-9);
}

TEST(PeerBody, WhoGivesWayKeepsMore) {
  const FleetParams params;
  const FleetMember peer = hovering_at({0, 0, 1.5});
  PeerView view{.now_s = 10.0, .own_enu_m = {20, 0, 1.5}, .gap_min_m = kGap_m};
  const double has_way = peer_body(peer, view, params).radius_m;
  view.gives_way = true;
  EXPECT_NEAR(peer_body(peer, view, params).radius_m, has_way + params.yield_m, 1e-9);
}

TEST(PeerBody, OfTwoExactlyOneGivesWay) {
  FleetMember a = hovering_at({0, 0, 1}), b = a;
  a.vehicle = "uav1";
  EXPECT_NE(gives_way(a, b), gives_way(b, a));
}

TEST(PeerBody, ItsPlacesAreThoseOfItsPlan) {
  FleetMember peer = hovering_at({0, 0, 1.5});
  peer.plan.start_s = 9.5;
  peer.plan.count = 1;
  peer.plan.pieces[0].duration_s = 2.0;
  peer.plan.pieces[0].coefficients.row(0) = Vec3(0, 0, 1.5).transpose();
  peer.plan.pieces[0].coefficients.row(1) = Vec3(1, 0, 0).transpose();
  const MovingBody body =
      peer_body(peer, {.now_s = 10.0, .own_enu_m = {20, 0, 1.5}, .gap_min_m = kGap_m}, {});
  EXPECT_NEAR(body.position_enu_m.x(), 0.5, 1e-9);
  EXPECT_NEAR(body.expected_at(11.0).x(), 1.5, 1e-9);
  EXPECT_NEAR(body.expected_at(13.0).x(), 2.0, 1e-9) << "then it stands";
}

TEST(PeerBody, ASilentOneGrowsButNeverOverThisVehicle) {
  const FleetParams params;
  const FleetMember peer = hovering_at({0, 0, 1.5});
  const auto at = [&](double age_s, double x_m) {
    return peer_body(peer, {.now_s = 10.0 + age_s, .own_enu_m = {x_m, 0, 1.5}, .gap_min_m = kGap_m},
                     params)
        .radius_m;
  };
  EXPECT_NEAR(at(0.3, 20.0), at(0.0, 20.0) + 0.5 * params.replan_m_s2 * 0.09, 1e-9);
  EXPECT_NEAR(at(params.silent_s, 20.0), at(0.0, 20.0) + params.replan_max_m, 1e-9);
  EXPECT_NEAR(at(params.silent_s + 0.5, 20.0), at(params.silent_s, 20.0) + 0.5 * params.growth_m_s,
              1e-9);
  EXPECT_NEAR(at(1e3, 20.0), at(params.silent_s, 20.0) + params.growth_max_m, 1e-9);
  EXPECT_LT(at(1e3, 2.5) + kGap_m + kHull_m, 2.5);
  EXPECT_EQ(at(1e3, 0.5), at(0.0, 0.5)) << "never less than what is kept anyway";
}

TEST(FollowingBody, ASilentOneMayFollowOn) {
  FleetMember peer = hovering_at({-2, 0, 1.5});
  peer.flies = true;
  peer.follows = 1;
  peer.person_count = 1;
  peer.persons[0].id = 1;
  peer.persons[0].position_enu_m = {0, 0, 1};
  TargetState person;
  person.stamp_s = 13.0;
  person.position_enu_m = {5, 3, 1};
  person.velocity_enu_m_s = {0, 1, 0};
  const FleetParams params;
  MovingBody body;
  PeerView view{.now_s = 10.5, .own_enu_m = {20, 0, 1.5}, .person = &person};
  EXPECT_FALSE(following_body(peer, view, params, body)) << "it is heard";
  view.now_s = 13.0;
  ASSERT_TRUE(following_body(peer, view, params, body));
  EXPECT_TRUE(body.position_enu_m.head<2>().isApprox(Vec2(3, 3)));
  EXPECT_TRUE(body.expected_at(14.0).head<2>().isApprox(Vec2(3, 4)));
  EXPECT_NE(body.id, peer_body(peer, view, params).id);
  peer.flies = false;
  EXPECT_FALSE(following_body(peer, view, params, body)) << "it has landed";
}

}  // namespace
}  // namespace foretrack
