// SPDX-License-Identifier: Apache-2.0
#include "services/convert/trajectory.hpp"

#include "convert_test_support.hpp"

namespace foretrack {
namespace {

using testing::kInf;
using testing::kNaN;
using M = foretrack_msgs::msg::PlannedTrajectory;

// Two pieces of one straight line at 1 m/s.
PlannedTrajectory plan() {
  PlannedTrajectory p;
  p.id = 1ull << 40;
  p.stamp_s = 10.0;
  p.start_s = 10.05;
  p.status = PlanStatus::kFresh;
  p.reason = PlanReason::kOk;
  for (const double x : {0.0, 2.0}) {
    QuinticPiece piece;
    piece.duration_s = 2.0;
    piece.coefficients.row(0) = Vec3(x, 1.0, 2.0).transpose();
    piece.coefficients.row(1) = Vec3(1.0, 0.0, 0.0).transpose();
    p.pieces.push_back(piece);
  }
  p.tail_start_s = 3.0;
  p.yaw = {0.1, {{0.0, 0.1}, {0.01, 0.1}, {0.02, 0.0}}};
  p.visible_regions.push_back({0.2, {3, 1, 1}, 0.5, 0.8, {1, 1, 2}});
  p.corridor.push_back(Polytope{{{1, 0, 0, 5}, {0, 1, 0, 4}}});
  return p;
}

M message(const PlannedTrajectory& p) {
  M msg;
  to_idl(p, msg);
  return msg;
}

TEST(PlannedTrajectoryMessage, RoundTrips) {
  const PlannedTrajectory in = plan();
  const auto out = from_idl(message(in));
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->id, in.id);
  EXPECT_EQ(out->stamp_s, in.stamp_s);
  EXPECT_NEAR(out->start_s, in.start_s, 1e-9);
  EXPECT_EQ(out->status, in.status);
  EXPECT_EQ(out->reason, in.reason);
  ASSERT_EQ(out->pieces.size(), 2u);
  EXPECT_EQ(out->pieces[1].coefficients, in.pieces[1].coefficients);
  EXPECT_EQ(out->duration_s(), in.duration_s());
  EXPECT_EQ(out->tail_start_s, in.tail_start_s);
  EXPECT_EQ(out->yaw.dt_s, in.yaw.dt_s);
  ASSERT_EQ(out->yaw.nodes.size(), 3u);
  EXPECT_EQ(out->yaw.nodes[1].angle_rad, 0.01);
  EXPECT_TRUE(out->gimbal_pitch.nodes.empty());
  ASSERT_EQ(out->visible_regions.size(), 1u);
  EXPECT_EQ(out->visible_regions[0].waypoint_enu_m, in.visible_regions[0].waypoint_enu_m);
  ASSERT_EQ(out->corridor.size(), 1u);
  EXPECT_EQ(out->corridor[0].planes, in.corridor[0].planes);
}

TEST(PlannedTrajectoryMessage, AHoldNeedsNoPieces) {
  PlannedTrajectory in;
  in.status = PlanStatus::kHold;
  in.reason = PlanReason::kNoTarget;
  const auto out = from_idl(message(in));
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->reason, PlanReason::kNoTarget);
}

TEST(PlannedTrajectoryMessage, SaysItsReasonInWords) {
  PlannedTrajectory in;
  in.status = PlanStatus::kHold;
  in.reason = PlanReason::kNoTarget;
  EXPECT_EQ(std::string(message(in).text().c_str()),
            std::string(to_string(in.status)) + ": " + std::string(to_string(in.reason)));
}

TEST(PlannedTrajectoryMessage, RefusesEachBadField) {
  testing::expect_each_refused<M>(
      message(plan()),
      testing::header_faults<M>() +
          std::vector<testing::PlantedFault<M>>{
              {"start", [](M& m) { m.start().sec(-5); }},
              {"status", [](M& m) { m.status(5); }},
              {"reason", [](M& m) { m.reason(200); }},
              {"pieces", [](M& m) { m.pieces().clear(); }},
              {"pieces", [](M& m) { m.pieces().resize(65, m.pieces()[0]); }},
              {"pieces.duration_s", [](M& m) { m.pieces()[0].duration_s(0.0); }},
              {"pieces.duration_s", [](M& m) { m.pieces()[0].duration_s(kNaN); }},
              {"pieces.duration_s", [](M& m) { m.pieces()[0].duration_s(1e6); }},
              {"pieces.coefficients", [](M& m) { m.pieces()[1].coefficients()[5][2] = kInf; }},
              {"pieces.position", [](M& m) { m.pieces()[1].coefficients()[5][2] = 1e8; }},
              {"pieces.velocity", [](M& m) { m.pieces()[0].coefficients()[1][0] = 300.0; }},
              {"pieces.position jump", [](M& m) { m.pieces()[1].coefficients()[0][1] += 0.02; }},
              {"pieces.velocity jump", [](M& m) { m.pieces()[1].coefficients()[1][1] += 0.1; }},
              {"tail_start_s", [](M& m) { m.tail_start_s(4.1); }},
              {"tail_start_s", [](M& m) { m.tail_start_s(kNaN); }},
              {"yaw.dt_s", [](M& m) { m.yaw().dt_s(0.0); }},
              {"yaw.nodes", [](M& m) { m.yaw().nodes().resize(513); }},
              {"yaw.nodes.angle_rad", [](M& m) { m.yaw().nodes()[2].angle_rad(kNaN); }},
              {"yaw.nodes.rate_radps", [](M& m) { m.yaw().nodes()[2].rate_radps(1e3); }},
              {"visible_regions", [](M& m) { m.visible_regions().resize(65); }},
              {"visible_regions.half_angle_rad",
               [](M& m) { m.visible_regions()[0].half_angle_rad(-0.1); }},
              {"visible_regions.waypoint_m",
               [](M& m) { m.visible_regions()[0].waypoint_m()[0] = kNaN; }},
              {"corridor", [](M& m) { m.corridor().resize(33); }},
              {"corridor.faces", [](M& m) { m.corridor()[0].faces().resize(65); }},
              {"corridor.faces.normal", [](M& m) { m.corridor()[0].faces()[0].normal()[0] = 0.5; }},
              {"corridor.faces.offset_m", [](M& m) { m.corridor()[0].faces()[0].offset_m(kNaN); }},
          },
      [](const M& m) { return from_idl(m); });
}

TEST(PlannedTrajectoryMessage, ThrowsRatherThanSendBeyondItsBounds) {
  PlannedTrajectory too_many = plan();
  too_many.pieces.resize(65, too_many.pieces[0]);
  M msg;
  EXPECT_THROW(to_idl(too_many, msg), std::length_error);
}

}  // namespace
}  // namespace foretrack
