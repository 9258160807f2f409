// SPDX-License-Identifier: Apache-2.0
#include "core/planning/motion/check_trajectory.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/common/random.hpp"
#include "core/planning/motion/stop_tail.hpp"

namespace foretrack {
namespace {

constexpr double kSide_m = 9.0;

/// A free box, 9 m × 9 m × 3 m, with some occupied or unknown columns.
GridMap make_map(std::initializer_list<std::pair<Vec2, Cell>> columns = {}) {
  GridMap map;
  map.resolution_m = 0.15;
  map.origin_enu_m = Vec3(-1.0, -kSide_m / 2, 0.0);
  map.size = {60, 60, 20};
  map.cells.assign(map.cell_count(), 0);
  for (const auto& [at, cell] : columns)
    for (int z = 0; z < map.size.z(); ++z) {
      Eigen::Vector3i i = map.index_of(Vec3(at.x(), at.y(), 1.0));
      i.z() = z;
      map.cells[map.offset_of(i)] = static_cast<std::uint8_t>(cell);
    }
  DistanceWorkspace workspace;
  update_distances(map, workspace);
  return map;
}

BoundaryState state_at(const QuinticPiece& piece, double t) {
  return {piece.position(t), piece.velocity(t), piece.acceleration(t)};
}

/// Flies straight from `from` at constant velocity, then stops. Yaw stands still.
PlannedTrajectory straight(const Vec3& from, const Vec3& velocity, double duration_s) {
  PlannedTrajectory trajectory;
  trajectory.pieces.resize(1);
  QuinticPiece& cruise = trajectory.pieces[0];
  cruise.duration_s = duration_s;
  cruise.coefficients.row(0) = from;
  cruise.coefficients.row(1) = velocity;
  trajectory.pieces.push_back(make_stop_tail(state_at(cruise, duration_s), {}).piece);
  trajectory.tail_start_s = duration_s;
  trajectory.yaw.nodes.assign(11, {});
  return trajectory;
}

CheckResult check(const PlannedTrajectory& trajectory, const GridMap& map,
                  const CheckParams& params = {}) {
  const CheckInputs inputs{map, state_at(trajectory.pieces[0], 0.0), {}};
  return check_trajectory(trajectory, inputs, {}, params);
}

const Vec3 kStart(0.0, 0.0, 1.5);
const Vec3 kForward(2.0, 0.0, 0.0);

TEST(CheckTrajectory, AcceptsAFreeTrajectory) {
  const CheckResult result = check(straight(kStart, kForward, 2.0), make_map());
  EXPECT_TRUE(result.ok()) << to_string(result.reason);
  EXPECT_NEAR(result.max_speed_m_s, 2.0, 1e-9);
  EXPECT_GT(result.min_clearance_m, 0.9);
}

TEST(CheckTrajectory, RejectsWhatDoesNotStartWhereTheVehicleIs) {
  const GridMap map = make_map();
  const PlannedTrajectory trajectory = straight(kStart, kForward, 2.0);
  const auto reason = [&](const Vec3& dp, const Vec3& dv, const Vec3& da, const AngleNode& yaw) {
    const CheckInputs inputs{map, {kStart + dp, kForward + dv, da}, yaw};
    return check_trajectory(trajectory, inputs, {}, {}).reason;
  };
  const Vec3 none = Vec3::Zero();
  EXPECT_EQ(reason(none, none, none, {}), PlanReason::kOk);
  EXPECT_EQ(reason({0.1, 0.0, 0.0}, none, none, {}), PlanReason::kDiscontinuous);
  EXPECT_EQ(reason(none, {0.0, 0.1, 0.0}, none, {}), PlanReason::kDiscontinuous);
  EXPECT_EQ(reason(none, none, {0.0, 0.0, 0.5}, {}), PlanReason::kDiscontinuous);
  EXPECT_EQ(reason(none, none, none, {0.3, 0.0}), PlanReason::kDiscontinuous);
  EXPECT_EQ(reason(none, none, none, {0.0, 0.3}), PlanReason::kDiscontinuous);
  EXPECT_EQ(reason(none, none, none, {2.0 * kPi, 0.0}), PlanReason::kOk);
}

TEST(CheckTrajectory, RejectsABreakBetweenPieces) {
  PlannedTrajectory trajectory = straight(kStart, kForward, 2.0);
  trajectory.pieces[1].coefficients(0, 1) += 0.1;
  const CheckResult result = check(trajectory, make_map());
  EXPECT_EQ(result.reason, PlanReason::kDiscontinuous);
  EXPECT_EQ(result.failed_at_s, 2.0);
}

TEST(CheckTrajectory, RejectsATailThatDoesNotEndAtRest) {
  PlannedTrajectory trajectory = straight(kStart, kForward, 2.0);
  trajectory.pieces.pop_back();
  EXPECT_EQ(check(trajectory, make_map()).reason, PlanReason::kDiscontinuous);
}

TEST(CheckTrajectory, RejectsNumbersThatAreNotFinite) {
  PlannedTrajectory trajectory = straight(kStart, kForward, 2.0);
  trajectory.pieces[0].coefficients(4, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(check(trajectory, make_map()).reason, PlanReason::kDiscontinuous);
  EXPECT_THROW(check_trajectory({}, {make_map(), {}, {}}, {}, {}), std::invalid_argument);
}

// A short excess between the samples of any coarse grid.
TEST(CheckTrajectory, FindsAShortExcessOfSpeedAndAcceleration) {
  const GridMap map = make_map();
  PlannedTrajectory trajectory = straight(kStart, {2.9, 0.0, 0.0}, 1.0);
  EXPECT_TRUE(check(trajectory, map).ok());
  trajectory = straight(kStart, {3.05, 0.0, 0.0}, 1.0);
  EXPECT_EQ(check(trajectory, map).reason, PlanReason::kLimitsViolated);

  // From rest to rest over 2.9 m in 1.7 s: peak speed 15/8 d/T, peak acceleration 10/√3 d/T².
  PlannedTrajectory jump = straight(kStart, Vec3::Zero(), 1.7);
  const double d = 2.9, T = 1.7;
  jump.pieces[0].coefficients.row(3) = Vec3(10.0 * d / std::pow(T, 3), 0.0, 0.0);
  jump.pieces[0].coefficients.row(4) = Vec3(-15.0 * d / std::pow(T, 4), 0.0, 0.0);
  jump.pieces[0].coefficients.row(5) = Vec3(6.0 * d / std::pow(T, 5), 0.0, 0.0);
  jump.pieces[1].coefficients.row(0) = jump.pieces[0].position(T);
  const CheckResult result = check(jump, map);
  EXPECT_NEAR(result.max_speed_m_s, 15.0 / 8.0 * d / T, 1e-9);
  EXPECT_NEAR(result.max_acceleration_m_s2, 10.0 / std::sqrt(3.0) * d / (T * T), 1e-9);
  EXPECT_EQ(result.reason, PlanReason::kLimitsViolated);
  EXPECT_NEAR(result.failed_at_s, T / 2, 1e-6);
}

TEST(CheckTrajectory, RejectsYawPlansBeyondTheLimits) {
  const GridMap map = make_map();
  PlannedTrajectory trajectory = straight(kStart, kForward, 2.0);
  const FlightLimits limits;
  const auto ramp = [&](double acceleration, int rising) {
    AngleNode node{};
    trajectory.yaw.nodes.assign(1, node);
    for (int k = 0; k < 2 * rising; ++k) {
      const double rate = node.rate_rad_s + (k < rising ? 0.1 : -0.1) * acceleration;
      node = {node.angle_rad + 0.05 * (node.rate_rad_s + rate), rate};
      trajectory.yaw.nodes.push_back(node);
    }
    return check(trajectory, map).reason;
  };
  const double a = limits.yaw_acceleration_max_rad_s2;
  EXPECT_EQ(ramp(0.99 * a, 3), PlanReason::kOk);
  EXPECT_EQ(ramp(1.01 * a, 3), PlanReason::kLimitsViolated);  // acceleration
  EXPECT_EQ(ramp(0.99 * a, 4), PlanReason::kLimitsViolated);  // rate
  trajectory.yaw.nodes.resize(4);                             // ends turning at full rate
  EXPECT_EQ(check(trajectory, map).reason, PlanReason::kLimitsViolated);
  trajectory.yaw.nodes.assign(11, {});
  trajectory.yaw.nodes[5].angle_rad = 0.2;  // a step that its rates do not explain
  EXPECT_EQ(check(trajectory, map).reason, PlanReason::kDiscontinuous);
  trajectory.yaw.nodes.clear();
  EXPECT_EQ(check(trajectory, map).reason, PlanReason::kDiscontinuous);
}

TEST(CheckTrajectory, RejectsObstaclesUnknownSpaceAndTheOutside) {
  const PlannedTrajectory trajectory = straight(kStart, kForward, 2.0);
  const auto reason = [&](const GridMap& map) { return check(trajectory, map).reason; };
  EXPECT_EQ(reason(make_map({{{2.0, 0.0}, Cell::kOccupied}})), PlanReason::kClearanceViolated);
  EXPECT_EQ(reason(make_map({{{2.0, 0.3}, Cell::kUnknown}})), PlanReason::kClearanceViolated);
  EXPECT_EQ(reason(make_map({{{2.0, 1.0}, Cell::kOccupied}})), PlanReason::kOk);
  EXPECT_EQ(check(straight(kStart, {0.0, 2.9, 0.0}, 1.3), make_map()).reason,
            PlanReason::kTailUnsafe);
  EXPECT_EQ(check(straight({0.0, 0.0, 9.0}, kForward, 2.0), make_map()).reason,
            PlanReason::kClearanceViolated);
}

TEST(CheckTrajectory, FindsAShortWayOutOfTheMapAndBack) {
  // The map ends at y = 4.5 m; y rises to 4.6 m and falls again, between points that are far
  // inside.
  PlannedTrajectory trajectory = straight({0.0, 4.1, 1.5}, {1.0, 1.0, 0.0}, 2.0);
  QuinticPiece& arc = trajectory.pieces[0];
  arc.coefficients(2, 1) = -0.5;
  trajectory.pieces[1] = make_stop_tail(state_at(arc, 2.0), {}).piece;
  EXPECT_EQ(check(trajectory, make_map()).reason, PlanReason::kClearanceViolated);
}

TEST(CheckTrajectory, BlamesTheTailForWhatTheTailHits) {
  const PlannedTrajectory trajectory = straight(kStart, kForward, 2.0);
  const CheckResult result = check(trajectory, make_map({{{4.6, 0.0}, Cell::kOccupied}}));
  EXPECT_EQ(result.reason, PlanReason::kTailUnsafe);
  EXPECT_GE(result.failed_at_s, 2.0);
}

TEST(CheckTrajectory, LetsAVehicleLeaveAnInflatedObstacleButNotApproachIt) {
  const GridMap map = make_map({{{-0.3, 0.0}, Cell::kOccupied}});
  ASSERT_LT(map.unfree_distance_m(kStart), 0.3);
  EXPECT_EQ(check(straight(kStart, kForward, 1.0), map).reason, PlanReason::kOk);
  EXPECT_NE(check(straight(kStart, -0.6 * kForward, 0.3), map).reason, PlanReason::kOk);
  const GridMap next = make_map({{{-0.3, 0.0}, Cell::kOccupied}, {{1.5, 0.0}, Cell::kOccupied}});
  EXPECT_EQ(check(straight(kStart, kForward, 1.0), next).reason, PlanReason::kClearanceViolated);
}

TEST(CheckTrajectory, NeverEntersAnOccupiedCellAgainAfterLeavingOne) {
  const GridMap map = make_map({{{0.0, 0.0}, Cell::kOccupied}, {{0.45, 0.0}, Cell::kOccupied}});
  ASSERT_TRUE(map.is_occupied(kStart));
  EXPECT_NE(check(straight(kStart, kForward, 1.0), map).reason, PlanReason::kOk);
  EXPECT_EQ(check(straight(kStart, -0.25 * kForward, 0.8), map).reason, PlanReason::kOk);
}

/// The claim itself, at many points: clearance of the radius everywhere, the start included.
bool clear_by_sampling(const PlannedTrajectory& trajectory, const GridMap& map, double radius_m) {
  const double duration_s = trajectory.duration_s();
  for (int k = 0; k <= 4000; ++k)
    if (map.unfree_distance_m(trajectory.position(duration_s * k / 4000.0)) < radius_m)
      return false;
  return true;
}

TEST(CheckTrajectory, AgreesWithDenseSamplingOnRandomTrajectories) {
  Random random(5);
  int rejected = 0, accepted = 0, missed = 0;
  for (int i = 0; i < 80; ++i) {
    const auto column = [&] {
      return std::pair(Vec2(random.uniform(1.0, 6.0), random.uniform(-2.0, 2.0)),
                       random.chance(0.5) ? Cell::kOccupied : Cell::kUnknown);
    };
    const GridMap map = make_map({column(), column(), column(), column(), column(), column()});
    const Vec3 velocity(random.uniform(0.0, 2.5), random.uniform(-1.0, 1.0), 0.0);
    const PlannedTrajectory trajectory = straight(kStart, velocity, random.uniform(0.5, 2.0));
    const double radius_m = CheckParams{}.vehicle_radius_m;
    if (map.unfree_distance_m(kStart) < radius_m) continue;
    const bool clear = clear_by_sampling(trajectory, map, radius_m);
    const bool ok = check(trajectory, map).ok();
    EXPECT_LE(clear, ok);  // nothing that is clear is rejected
    missed += ok && !clear;
    (ok ? accepted : rejected)++;
  }
  EXPECT_GT(rejected, 15);
  EXPECT_GT(accepted, 15);
  EXPECT_LE(missed, 2);  // corners cut by less than half a cell
}

TEST(CheckTrajectory, KeepsItsGapToEverybodyWhoMoves) {
  const GridMap map = make_map();
  const auto reason = [&](const Vec3& foot) {
    const GapParams body;
    BodyCourses courses;
    MovingBody person;
    person.position_enu_m = foot;
    courses.add({person, 1.0, body.body_horizon_s});
    const PlannedTrajectory trajectory = straight(kStart, kForward, 1.5);
    const CheckInputs inputs{map, state_at(trajectory.pieces[0], 0.0), {}, &courses, &body};
    return check_trajectory(trajectory, inputs, {}, {}).reason;
  };
  EXPECT_EQ(reason({3.0, 0.0, 0.0}), PlanReason::kTooNearTarget);
  EXPECT_EQ(reason({2.5, 0.9, 0.0}), PlanReason::kTooNearTarget);
  EXPECT_EQ(reason({2.5, 1.8, 0.0}), PlanReason::kOk);
}

}  // namespace
}  // namespace foretrack
