// SPDX-License-Identifier: Apache-2.0
#include "core/planning/plan.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/core/planning/plan_loop.hpp"
#include "tests/core/planning/planning_worlds.hpp"

namespace foretrack {
namespace {

using testing::empty_world;
using testing::forest;
using testing::hovering;

TargetState target_at(const Vec3& position, const Vec3& velocity, double now_s) {
  TargetState target;
  target.stamp_s = now_s;
  target.status = TrackStatus::kTracking;
  target.position_enu_m = position;
  target.velocity_enu_m_s = velocity;
  return target;
}

PlanInput input_of(const GridMap& map, const VehicleState& vehicle, const TargetState& target) {
  PlanInput input;
  input.now_s = vehicle.stamp_s;
  input.vehicle = vehicle;
  input.target = target;
  input.map = &map;
  return input;
}

bool is_finite(const PlannedTrajectory& t) {
  for (const auto& piece : t.pieces)
    if (!piece.coefficients.allFinite() || !std::isfinite(piece.duration_s)) return false;
  for (const auto& node : t.yaw.nodes)
    if (!std::isfinite(node.angle_rad) || !std::isfinite(node.rate_rad_s)) return false;
  return true;
}

double end_speed(const PlannedTrajectory& t) {
  const double end_s = t.pieces.back().duration_s;
  return t.pieces.back().velocity(end_s).norm();
}

class Plan : public ::testing::Test {
 protected:
  const PlannedTrajectory& replan(const PlanInput& input) {
    return plan(state_, input, params_).trajectory;
  }
  const GridMap open_ = known_map(empty_world(), 0.15);
  PlanningState state_;
  PlanningParams params_;
};

TEST_F(Plan, FliesToTheBandAndEndsAtRestWithACheckedTail) {
  const auto vehicle = hovering({-5.0, 0.0, 1.5}, 0.0, 1.0);
  const auto& t = replan(input_of(open_, vehicle, target_at({0, 0, 1}, {0, 0, 0}, 1.0)));
  ASSERT_EQ(t.status, PlanStatus::kFresh);
  EXPECT_EQ(t.reason, PlanReason::kOk);
  EXPECT_NEAR(distance_xy(t.position(t.tail_start_s), {0, 0, 1}), 2.0, 0.5);
  EXPECT_LT(end_speed(t), 1e-6);
  EXPECT_GE(t.tail_start_s, 3.0 - 1e-6);
  EXPECT_LT(t.tail_start_s, t.duration_s());
  EXPECT_EQ(t.visible_regions.size(), 15U);
  EXPECT_FALSE(t.corridor.empty());
}

TEST_F(Plan, LooksAtWhereTheTargetWillBe) {
  const auto vehicle = hovering({-2.0, 0.0, 1.5}, 0.0, 1.0);
  const auto& t = replan(input_of(open_, vehicle, target_at({0, 0, 1}, {0, 1.5, 0}, 1.0)));
  ASSERT_EQ(t.status, PlanStatus::kFresh);
  for (double at_s = 0.2; at_s < 3.0; at_s += 0.2) {
    const Vec3 offset = Vec3(0, 1.5 * (at_s + 0.05), 1) - t.position(at_s);
    const double off_rad = wrap_angle(yaw_of(Vec2(offset.head<2>())) - t.yaw.at(at_s).angle_rad);
    EXPECT_LT(std::abs(off_rad), 0.15) << "at " << at_s;
  }
}

TEST_F(Plan, AGimbalPointsAtTheTargetToo) {
  params_.view.gimbal = true;
  const auto vehicle = hovering({-2.0, 0.0, 2.0}, 0.0, 1.0);
  const auto& t = replan(input_of(open_, vehicle, target_at({0, 0, 1}, {0, 0, 0}, 1.0)));
  const Vec3 end = t.position(3.0);
  EXPECT_NEAR(t.gimbal_pitch.at(3.0).angle_rad,
              std::atan2(1.0 - end.z(), distance_xy(end, {0, 0, 1})), 0.02);
}

// A target that walks along a street and turns left round a block; predicted as two paths until it
// has turned.
class Corner : public Plan {
 protected:
  Corner() {
    world_ = empty_world(10.0);
    world_.boxes.push_back({{-10.0, 1.2, 0.0}, {0.0, 10.0, 4.0}});
    map_ = known_map(world_, 0.15);
  }
  static constexpr double kSpeed_m_s = 1.5, kTurn_m = 1.0;

  static Vec3 walked(double t_s, bool turns) {
    const double way_m = -7.0 + kSpeed_m_s * t_s;
    if (!turns || way_m < kTurn_m) return {way_m, 0.0, 1.0};
    return {kTurn_m, way_m - kTurn_m, 1.0};
  }
  static PredictedPath path(double now_s, bool turns, double probability) {
    PredictedPath out;
    out.probability = probability;
    out.intention = static_cast<Intention>(turns);
    for (int k = 1; k <= 15; ++k) {
      PredictedState s;
      s.time_s = 0.2 * k;
      s.position_enu_m = walked(now_s + s.time_s, turns);
      s.velocity_enu_m_s = (walked(now_s + s.time_s + 1e-3, turns) - s.position_enu_m) / 1e-3;
      out.states.push_back(s);
    }
    return out;
  }
  static Prediction predicted(double now_s) {
    Prediction prediction;
    prediction.stamp_s = now_s;
    prediction.status = PredictionStatus::kOk;
    const bool turned = walked(now_s, true).y() > 0.0;
    if (!turned) prediction.paths.push_back(path(now_s, false, 0.65));
    prediction.paths.push_back(path(now_s, true, turned ? 1.0 : 0.35));
    return prediction;
  }

  struct Flight {
    double hidden_s = 0.0, worst_distance_m = 0.0, least_distance_m = 1e9, least_clearance_m = 1e9;
    double worst_jump_m = 0.0, worst_velocity_jump_m_s = 0.0;
    int not_fresh = 0;
  };

  Flight fly() {
    Flight out;
    VehicleState vehicle = hovering({-9.0, 0.0, 1.5}, 0.0, 0.0);
    constexpr double kDt_s = 0.1;
    for (double now_s = 0.0; now_s < 8.0; now_s += kDt_s) {
      const Prediction prediction = predicted(now_s);
      const Vec3 p = walked(now_s, true);
      const Vec3 v = (walked(now_s + 1e-3, true) - p) / 1e-3;
      PlanInput input = input_of(map_, vehicle, target_at(p, v, now_s));
      input.prediction = &prediction;
      const PlannedTrajectory before = state_.results[state_.flown].trajectory;
      const PlannedTrajectory& t = replan(input);
      out.not_fresh += t.status != PlanStatus::kFresh;
      if (!before.pieces.empty() && before.id != t.id) {
        const double joint_s = t.start_s - before.start_s;
        out.worst_jump_m =
            std::max(out.worst_jump_m, (t.position(0.0) - before.position(joint_s)).norm());
        out.worst_velocity_jump_m_s = std::max(out.worst_velocity_jump_m_s,
                                               (t.velocity(0.0) - before.velocity(joint_s)).norm());
      }
      vehicle = testing::state_on(t, now_s + kDt_s);
      const Vec3 target = walked(now_s + kDt_s, true);
      const double distance_m = distance_xy(vehicle.position_enu_m, target);
      if (!line_of_sight(world_, vehicle.position_enu_m, target)) out.hidden_s += kDt_s;
      out.worst_distance_m = std::max(out.worst_distance_m, distance_m);
      out.least_distance_m = std::min(out.least_distance_m, distance_m);
      out.least_clearance_m =
          std::min(out.least_clearance_m, clearance_m(world_, vehicle.position_enu_m));
    }
    return out;
  }

  World world_;
  GridMap map_;
};

TEST_F(Corner, KeepsTheTargetInSightAndInTheBandAllTheWay) {
  const Flight flight = fly();
  EXPECT_EQ(flight.not_fresh, 0);
  EXPECT_EQ(flight.hidden_s, 0.0);
  EXPECT_GT(flight.least_distance_m, 1.2);
  EXPECT_LT(flight.worst_distance_m, 2.8);
  EXPECT_GT(flight.least_clearance_m, 0.3);
}

TEST_F(Corner, EachTrajectoryJoinsTheOneBefore) {
  const Flight flight = fly();
  EXPECT_LT(flight.worst_jump_m, 1e-6);
  EXPECT_LT(flight.worst_velocity_jump_m_s, 1e-6);
}

TEST_F(Corner, HedgingKeepsNearerToThePathThatIsLessLikely) {
  const auto excess_m = [&](double now_s, bool hedging) {
    PlanningState state;
    params_.horizon.hedging = hedging;
    const Prediction prediction = predicted(now_s);
    VehicleState vehicle = hovering({walked(now_s, true).x() - 2.0, 0.0, 1.5}, 0.0, now_s);
    vehicle.velocity_enu_m_s = {kSpeed_m_s, 0.0, 0.0};
    PlanInput input =
        input_of(map_, vehicle, target_at(walked(now_s, true), {kSpeed_m_s, 0, 0}, now_s));
    input.prediction = &prediction;
    const PlannedTrajectory& t = plan(state, input, params_).trajectory;
    EXPECT_EQ(t.status, PlanStatus::kFresh);
    double sum_m = 0.0;
    for (const PredictedState& s : prediction.paths[1].states) {
      const double d_m = distance_xy(t.position(now_s + s.time_s - t.start_s), s.position_enu_m);
      sum_m += std::max(0.0, d_m - params_.place.distance_high_m);
    }
    return sum_m;
  };
  // As the target comes to the corner, going on is more likely than turning.
  double hedged_m = 0.0, unhedged_m = 0.0;
  for (const double now_s : {4.5, 4.7, 4.9, 5.1, 5.3}) {
    hedged_m += excess_m(now_s, true);
    unhedged_m += excess_m(now_s, false);
  }
  EXPECT_LT(hedged_m, 0.7 * unhedged_m);
}

TEST_F(Corner, TheTurnScoreWidensTheMarginOnItsSide) {
  const double now_s = 3.6;
  const auto bisector_rad = [&](double left_score) {
    PlanningState state;
    IntentionAssessment intention;
    intention.stamp_s = now_s;
    intention.margins.left = left_score;
    VehicleState vehicle = hovering({walked(now_s, true).x() - 2.0, 0.0, 1.5}, 0.0, now_s);
    PlanInput input =
        input_of(map_, vehicle, target_at(walked(now_s, true), {kSpeed_m_s, 0, 0}, now_s));
    input.intention = &intention;
    const PlannedTrajectory& t = plan(state, input, params_).trajectory;
    const auto& regions = t.visible_regions;
    return regions.empty() ? 99.0 : wrap_angle(regions.front().bisector_rad - kPi);
  };
  // Walking east, left is north: the sector (around west = π) turns to the south, which is ahead in
  // the counter-clockwise sense.
  EXPECT_GT(bisector_rad(1.0), bisector_rad(0.0) + 0.1);
  params_.horizon.intention_margins = false;
  EXPECT_EQ(bisector_rad(1.0), bisector_rad(0.0));
}

TEST_F(Plan, ALikelyDecelerationKeepsMoreDistance) {
  const auto distance_m = [&](double score) {
    PlanningState state;
    IntentionAssessment intention;
    intention.stamp_s = 1.0;
    intention.margins.distance = score;
    PlanInput input = input_of(open_, hovering({-2.0, 0.0, 1.5}, 0.0, 1.0),
                               target_at({-0.4, 0, 1}, {0, 0, 0}, 1.0));
    input.intention = &intention;
    return distance_xy(plan(state, input, params_).trajectory.position(3.0), {-0.4, 0, 1});
  };
  EXPECT_GT(distance_m(1.0), distance_m(0.0) + 0.1);
}

TEST_F(Plan, WithoutATargetTheVehicleStopsAndHolds) {
  auto vehicle = hovering({0, 0, 1.5}, 0.3, 1.0);
  vehicle.velocity_enu_m_s = {1.0, 0.0, 0.0};
  const auto& t = replan(input_of(open_, vehicle, {}));
  EXPECT_EQ(t.status, PlanStatus::kHold);
  EXPECT_EQ(t.reason, PlanReason::kNoTarget);
  EXPECT_LT(end_speed(t), 1e-9);
  EXPECT_NEAR(t.yaw.nodes.back().angle_rad, 0.3, 1e-9);
}

// Who is lost may be near: then what is flown goes on, or a way out is flown.
bool is_search_or_keeps_clear(const PlannedTrajectory& t) {
  if (t.status == PlanStatus::kSearch)
    return t.reason == PlanReason::kTargetLost || t.reason == PlanReason::kTooNearTarget;
  return t.reason == PlanReason::kTooNearTarget;
}

TEST_F(Plan, SearchesForALostTargetAndThenWaitsAndLooksWhereTheyMostLikelyAre) {
  params_.horizon.search_s = 20.0;
  auto vehicle = hovering({-2.0, 0.0, 1.5}, 0.0, 1.0);
  replan(input_of(open_, vehicle, target_at({0, 0, 1}, {1.5, 0, 0}, 1.0)));
  TargetState lost = target_at({0, 0, 1}, {1.5, 0, 0}, 1.0);
  lost.status = TrackStatus::kLost;
  int replans = 0, searches = 0, evades = 0;
  for (double now_s = 1.1; now_s < 8.0; now_s += 0.1) {
    vehicle = testing::state_on(state_.results[state_.flown].trajectory, now_s);
    const auto& t = replan(input_of(open_, vehicle, lost));
    ++replans;
    if (is_search_or_keeps_clear(t)) ++(t.status == PlanStatus::kSearch ? searches : evades);
  }
  EXPECT_EQ(searches + evades, replans);
  EXPECT_LT(evades, 0.1 * replans);
  EXPECT_GT(state_.search.viewpoint.worth, 0.0);
  PlanStatus last = PlanStatus::kNone;
  for (double now_s = 8.0; now_s < 1.1 + params_.horizon.search_s + 6.0; now_s += 0.1) {
    vehicle = testing::state_on(state_.results[state_.flown].trajectory, now_s);
    last = replan(input_of(open_, vehicle, lost)).status;
  }
  EXPECT_EQ(last, PlanStatus::kHold);
  EXPECT_TRUE(state_.search.waits);
  EXPECT_LT(vehicle.velocity_enu_m_s.norm(), 0.1);
  const Vec2 likeliest = state_.search.likeliest_m - vehicle.position_enu_m.head<2>();
  EXPECT_LT(std::abs(wrap_angle(vehicle.yaw_rad() - yaw_of(likeliest))), 0.7);
}

// The person may have stopped in its way.
TEST_F(Plan, SlowsDownForASearchUntilItIsKnownWhereNobodyIs) {
  auto vehicle = hovering({-2.0, 0.0, 1.5}, 0.0, 1.0);
  TargetState target = target_at({0, 0, 1}, {2.5, 0, 0}, 1.0);
  double now_s = 1.0, fastest_m_s = 0.0;
  for (; now_s < 3.0; now_s += 0.1) {
    target.stamp_s = now_s;
    target.position_enu_m.x() = 2.5 * (now_s - 1.0);
    vehicle = testing::state_on(replan(input_of(open_, vehicle, target)), now_s + 0.1);
  }
  ASSERT_GT(vehicle.velocity_enu_m_s.norm(), 2.0);
  target.status = TrackStatus::kLost;
  for (const double lost_s = now_s; now_s < lost_s + 6.0; now_s += 0.1) {
    PlanInput input = input_of(open_, vehicle, target);
    input.now_s = now_s;
    const auto& t = replan(input);
    EXPECT_TRUE(is_search_or_keeps_clear(t));
    vehicle = testing::state_on(t, now_s + 0.1);
    if (now_s > lost_s + 1.5 && now_s < lost_s + 1.8)
      fastest_m_s = std::max(fastest_m_s, vehicle.velocity_enu_m_s.norm());
    EXPECT_LT(vehicle.velocity_enu_m_s.norm(),
              now_s < lost_s + 1.5 ? 3.0 : search_speed_m_s(state_.search, params_) + 0.6);
  }
  EXPECT_LT(fastest_m_s, 1.1 * params_.view.search_speed_m_s);
}

TEST_F(Plan, KeepsFlyingTheLastTrajectoryWhenItsInputsAreStaleOrBroken) {
  const auto vehicle = hovering({-5.0, 0.0, 1.5}, 0.0, 1.0);
  const auto target = target_at({0, 0, 1}, {0, 0, 0}, 1.0);
  const std::uint64_t id = replan(input_of(open_, vehicle, target)).id;
  PlanInput stale = input_of(open_, vehicle, target);
  stale.now_s = 2.0;
  PlanInput broken = input_of(open_, vehicle, target);
  broken.vehicle.position_enu_m.x() = std::nan("");
  PlanInput mapless = input_of(open_, vehicle, target);
  mapless.map = nullptr;
  for (const PlanInput& input : {stale, broken, mapless}) {
    const auto& t = replan(input);
    EXPECT_EQ(t.status, PlanStatus::kKept);
    EXPECT_EQ(t.reason, PlanReason::kStaleInput);
    EXPECT_EQ(t.id, id);
    EXPECT_TRUE(is_finite(t));
  }
}

TEST_F(Plan, HasNothingToFlyWithoutAVehicleState) {
  PlanInput input = input_of(open_, hovering({0, 0, 1.5}, 0.0, 1.0), {});
  input.now_s = 9.0;
  EXPECT_EQ(replan(input).status, PlanStatus::kNone);
}

TEST_F(Plan, ATargetWithNonsenseForAStateIsNoTarget) {
  auto target = target_at({0, 0, 1}, {0, 0, 0}, 1.0);
  target.velocity_enu_m_s.y() = std::nan("");
  const auto& t = replan(input_of(open_, hovering({-5.0, 0.0, 1.5}, 0.0, 1.0), target));
  EXPECT_EQ(t.reason, PlanReason::kNoTarget);
  EXPECT_TRUE(is_finite(t));
}

TEST_F(Plan, BrakesWhenSomethingNewStandsInTheWayAndNoPlanIsFound) {
  auto vehicle = hovering({-5.0, 0.0, 1.5}, 0.0, 1.0);
  replan(input_of(open_, vehicle, target_at({2, 0, 1}, {1.5, 0, 0}, 1.0)));
  World world = empty_world();
  world.boxes.push_back({{-2.5, -8.0, 0.0}, {-2.3, 8.0, 4.0}});
  const GridMap blocked = known_map(world, 0.15);
  vehicle = testing::state_on(state_.results[state_.flown].trajectory, 1.5);
  TargetState lost = target_at({2, 0, 1}, {1.5, 0, 0}, 1.0);
  lost.status = TrackStatus::kLost;
  params_.horizon.search_s = 0.0;
  const auto& t = replan(input_of(blocked, vehicle, lost));
  EXPECT_EQ(t.status, PlanStatus::kHold);
  EXPECT_EQ(t.reason, PlanReason::kTargetLost);
  EXPECT_LT(t.position(t.duration_s()).x(), -2.5);
}

TEST_F(Plan, StartsFromTheMeasuredStateWhenTheVehicleIsElsewhere) {
  auto vehicle = hovering({-5.0, 0.0, 1.5}, 0.0, 1.0);
  const auto target = target_at({0, 0, 1}, {0, 0, 0}, 1.0);
  replan(input_of(open_, vehicle, target));
  vehicle = hovering({-5.0, 3.0, 1.5}, 0.0, 1.2);
  const auto& t = replan(input_of(open_, vehicle, target));
  EXPECT_EQ(t.status, PlanStatus::kFresh);
  EXPECT_NEAR((t.position(0.0) - vehicle.position_enu_m).norm(), 0.0, 1e-6);
}

TEST_F(Plan, FliesOutOfAnInflatedObstacle) {
  World world = empty_world();
  world.boxes.push_back({{-8.0, -2.0, 0.0}, {-3.0, 2.0, 4.0}});
  const GridMap map = known_map(world, 0.15);
  const Vec3 start(-2.83, 0.0, 1.5);
  ASSERT_LT(map.unfree_distance_m(start), 0.25);
  const auto& t =
      replan(input_of(map, hovering(start, 0.0, 1.0), target_at({1.5, 0, 1}, {0.5, 0, 0}, 1.0)));
  EXPECT_EQ(t.status, PlanStatus::kFresh);
  EXPECT_GE(map.unfree_distance_m(t.position(2.0)), params_.check.vehicle_radius_m);
}

TEST_F(Plan, GoesAsNearAsTheMapIsKnownAndFree) {
  const GridMap map =
      testing::partly_known_map(empty_world(), 0.15, [](const Vec3& p) { return p.x() < 0.0; });
  const auto& t = replan(
      input_of(map, hovering({-6.0, 0.0, 1.5}, 0.0, 1.0), target_at({5.0, 0, 1}, {0, 0, 0}, 1.0)));
  EXPECT_EQ(t.status, PlanStatus::kFresh);
  EXPECT_GT(t.position(3.0).x(), -2.0);
  EXPECT_LT(t.position(t.duration_s()).x(), -0.25);
}

TEST_F(Plan, RisesOrSinksToALevelThatIsFree) {
  World world = empty_world();
  world.boxes.push_back({{-8.0, -8.0, 1.6}, {8.0, 8.0, 4.0}});  // a low ceiling
  const GridMap map = known_map(world, 0.15);
  const auto& t = replan(
      input_of(map, hovering({-5.0, 0.0, 0.9}, 0.0, 1.0), target_at({0.0, 0, 1}, {0, 0, 0}, 1.0)));
  EXPECT_EQ(t.status, PlanStatus::kFresh);
  for (double at_s = 0.0; at_s < t.duration_s(); at_s += 0.05)
    EXPECT_LT(t.position(at_s).z(), 1.3 + 1e-6);
}

TEST_F(Plan, SameInputsGiveTheSamePlan) {
  const GridMap map = known_map(forest(5, 40), 0.15);
  const auto input = input_of(map, hovering({-1.0, 0.0, 1.5}, 0.0, 1.0),
                              target_at({1.0, 0.2, 1}, {1.0, 0.5, 0}, 1.0));
  PlanningState other;
  const PlannedTrajectory& a = plan(state_, input, params_).trajectory;
  const PlannedTrajectory& b = plan(other, input, params_).trajectory;
  ASSERT_EQ(a.pieces.size(), b.pieces.size());
  for (std::size_t i = 0; i < a.pieces.size(); ++i)
    EXPECT_EQ(a.pieces[i].coefficients, b.pieces[i].coefficients);
}

double fake_clock_s() {
  static double now_s = 0.0;
  return now_s += 1e-3;
}

TEST_F(Plan, GivesTheTimeOfEachStageIfThereIsAClock) {
  state_.clock_s = fake_clock_s;
  const auto input =
      input_of(open_, hovering({-5.0, 0.0, 1.5}, 0.0, 1.0), target_at({0, 0, 1}, {0, 0, 0}, 1.0));
  const PlanResult& result = plan(state_, input, params_);
  for (const double ms : result.diagnostics.stage_ms) EXPECT_GE(ms, 1.0 - 1e-9);
  state_.clock_s = nullptr;
  for (const double ms : plan(state_, input, params_).diagnostics.stage_ms) EXPECT_EQ(ms, 0.0);
}

TEST(PlanningParameters, HaveUniqueNamesAndValidDefaults) {
  PlanningParams params;
  std::set<std::string_view> names;
  for (const ParamRow& row : rows(params)) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_FALSE(row.meaning.empty()) << row.name;
  }
  EXPECT_TRUE(faults_of(rows(params)).empty());
}

}  // namespace
}  // namespace foretrack
