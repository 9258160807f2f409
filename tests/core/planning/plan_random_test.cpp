// SPDX-License-Identifier: Apache-2.0
// Whatever the world and the states are: no crash, no NaN, and nothing is flown that fails the
// check. FORETRACK_RANDOM_WORLDS raises the number of worlds (50 plans each).
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/core/planning/plan_loop.hpp"
#include "tests/core/planning/planning_worlds.hpp"
#include "tests/support/count_allocations.hpp"

namespace foretrack {
namespace {

constexpr int kPlansOfAWorld = 50;
constexpr double kHalf_m = 5.0;

int world_count() {
  const char* text = std::getenv("FORETRACK_RANDOM_WORLDS");
  return text == nullptr ? 24 : std::atoi(text);
}

// Boxes and cylinders anywhere, some of it unknown.
GridMap random_map(Random& random) {
  World world = testing::empty_world(kHalf_m);
  world.max_m.z() = random.uniform(2.0, 3.5);
  const int count = random.integer(0, 18);
  for (int i = 0; i < count; ++i) {
    const Vec3 center(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(0, 3));
    const Vec3 half(random.uniform(0.05, 1.0), random.uniform(0.05, 1.0), random.uniform(0.1, 2.0));
    if (random.chance(0.5))
      world.boxes.push_back({center - half, center + half});
    else
      world.cylinders.push_back({center.head<2>(), half.x(), 3.5, 0.0});
  }
  const Vec3 hidden(random.uniform(-5, 5), random.uniform(-5, 5), 1.0);
  const double hidden_m = random.chance(0.5) ? random.uniform(0.5, 4.0) : 0.0;
  return testing::partly_known_map(world, 0.2,
                                   [&](const Vec3& p) { return (p - hidden).norm() > hidden_m; });
}

Vec3 random_place(Random& random, double reach_m = kHalf_m) {
  return {random.uniform(-reach_m, reach_m), random.uniform(-reach_m, reach_m),
          random.uniform(0.3, 2.2)};
}
Vec3 random_velocity(Random& random, double most_m_s) {
  if (random.chance(0.3)) return Vec3::Zero();
  return random.uniform(0.0, most_m_s) *
         Vec3(random.normal(), random.normal(), 0.2 * random.normal()).normalized();
}

TargetState random_target(Random& random, const VehicleState& vehicle) {
  TargetState target;
  target.stamp_s = vehicle.stamp_s - random.uniform(0.0, 0.2);
  const double status = random.uniform();
  target.status = status < 0.85   ? TrackStatus::kTracking
                  : status < 0.95 ? TrackStatus::kLost
                                  : TrackStatus::kNone;
  target.position_enu_m = random_place(random, 5.5);
  if (random.chance(0.1)) target.position_enu_m = vehicle.position_enu_m;  // right below, or in it
  target.velocity_enu_m_s = random_velocity(random, 2.5);
  return target;
}

// Paths that may run anywhere, through walls too.
Prediction random_prediction(Random& random, const TargetState& target) {
  Prediction prediction;
  prediction.stamp_s = target.stamp_s - random.uniform(0.0, 0.3);
  prediction.status = random.chance(0.9) ? PredictionStatus::kOk : PredictionStatus::kTargetBlocked;
  const int count = random.integer(0, 4);
  for (int i = 0; i < count; ++i) {
    PredictedPath path;
    path.probability = 1.0 / count;
    path.intention = static_cast<Intention>(i);
    PredictedState state;
    state.position_enu_m = target.position_enu_m;
    state.velocity_enu_m_s = target.velocity_enu_m_s;
    const double turn_rad = random.uniform(-0.3, 0.3);
    for (int k = 1; k <= 15; ++k) {
      state.time_s = 0.2 * k;
      state.velocity_enu_m_s = Eigen::AngleAxisd(turn_rad, Vec3::UnitZ()) * state.velocity_enu_m_s;
      state.position_enu_m += 0.2 * state.velocity_enu_m_s;
      path.states.push_back(state);
    }
    prediction.paths.push_back(path);
  }
  return prediction;
}

void expect_finite(const PlannedTrajectory& t) {
  for (const auto& piece : t.pieces) {
    ASSERT_TRUE(piece.coefficients.allFinite());
    ASSERT_GT(piece.duration_s, 0.0);
  }
  for (const auto& node : t.yaw.nodes) ASSERT_TRUE(std::isfinite(node.angle_rad));
  for (const auto& region : t.visible_regions) ASSERT_TRUE(std::isfinite(region.bisector_rad));
  ASSERT_LT(t.duration_s(), 60.0);
}

Vec3 into_map(const GridMap& map, const Vec3& p, double from_edge_m = 1e-6) {
  const Vec3 low = map.origin_enu_m + Vec3::Constant(from_edge_m);
  const Vec3 high = map.origin_enu_m + map.resolution_m * map.size.cast<double>();
  return p.cwiseMax(low).cwiseMin(high - Vec3::Constant(from_edge_m));
}

// The claims of the check, by sampling.
void expect_flyable(const PlannedTrajectory& t, const GridMap& map, Passable passable,
                    const PlanningParams& params) {
  double allowed_m =
      std::min(params.check.vehicle_radius_m, map.clearance_m(t.position(0.0), passable));
  for (double at_s = 0.0; at_s < t.duration_s(); at_s += 0.02) {
    ASSERT_LE(t.velocity(at_s).norm(), 1.002 * params.limits.speed_max_m_s);
    ASSERT_LE(t.acceleration(at_s).norm(), 1.002 * params.limits.acceleration_max_m_s2);
    // The check looks at points a quarter of a cell apart: less than that, the map's edge may be
    // grazed.
    const Vec3 p = t.position(at_s), inside = into_map(map, p);
    if (allowed_m > 0.0) {
      ASSERT_LT((p - inside).norm(), 0.25 * map.resolution_m) << "at " << at_s;
    }
    const double clearance_m = map.clearance_m(inside, passable);
    // Beside the check's own samples, the corner of one more cell may be cut.
    ASSERT_GE(clearance_m, allowed_m - map.resolution_m)
        << "at " << at_s << " s, " << t.position(at_s).transpose();
    // From outside the map, its edge may be grazed as well before it is entered.
    const bool entered = (p - into_map(map, p, 0.5 * map.resolution_m)).norm() < 1e-9;
    if (entered && map.clearance_m(p, passable) >= params.check.vehicle_radius_m)
      allowed_m = params.check.vehicle_radius_m;
  }
  ASSERT_LT(t.velocity(t.duration_s() - 1e-6).norm(), 1e-2);
}

TEST(PlanAnything, IsFiniteAndWhatIsNewPassedTheCheck) {
  PlanningParams params;
  int fresh = 0, plans = 0;
  for (int w = 0; w < world_count(); ++w) {
    Random random(static_cast<std::uint64_t>(w) + 1);
    const GridMap map = random_map(random);
    PlanningState state;
    VehicleState vehicle = testing::hovering(random_place(random), 0.0, 10.0);
    for (int i = 0; i < kPlansOfAWorld; ++i, ++plans) {
      params.horizon.hedging = random.chance(0.8);
      const double now_s = 10.0 + 0.1 * i;
      const PlannedTrajectory& flown = state.results[state.flown].trajectory;
      if (flown.pieces.empty() || random.chance(0.3)) {
        vehicle = testing::hovering(random_place(random, 5.5), random.uniform(-3, 3), now_s);
        vehicle.velocity_enu_m_s = random_velocity(random, 4.0);
      } else {
        vehicle = testing::state_on(flown, now_s);
      }
      const TargetState target = random_target(random, vehicle);
      const Prediction prediction = random_prediction(random, target);
      IntentionAssessment intention;
      intention.stamp_s = now_s;
      intention.margins = {random.uniform(), random.uniform(), random.uniform()};
      const PlanInput input{now_s,
                            vehicle,
                            target,
                            random.chance(0.9) ? &intention : nullptr,
                            random.chance(0.9) ? &prediction : nullptr,
                            &map};
      const PlannedTrajectory& t = plan(state, input, params).trajectory;
      ASSERT_NO_FATAL_FAILURE(expect_finite(t)) << "world " << w << ", plan " << i;
      ASSERT_FALSE(t.pieces.empty());
      if (t.status != PlanStatus::kFresh && t.status != PlanStatus::kSearch) continue;
      ++fresh;
      ASSERT_NO_FATAL_FAILURE(expect_flyable(t, map, state.flown_through, params))
          << "world " << w << ", plan " << i;
    }
  }
  EXPECT_GT(fresh, plans / 4);
}

TEST(PlanAnything, AllocatesNothingOnceItIsWarm) {
  const World world = testing::forest(4, 60, 10.0);
  const GridMap map = known_map(world, 0.15);
  PlanningState state;
  PlanningParams params;
  testing::Walker walker(world, Vec2::Zero(), 1.5, 3);
  VehicleState vehicle = testing::hovering({-1.0, 0.0, 1.5}, 0.0, 0.0);
  long allocated = 0;
  for (int i = 0; i < 200; ++i) {
    const double now_s = 0.1 * i;
    const PlanInput input{now_s, vehicle, walker.state(now_s), nullptr, nullptr, &map};
    const long before = allocation_count();
    const PlanResult& result = plan(state, input, params);
    if (i >= 100) allocated += allocation_count() - before;
    for (int j = 0; j < 5; ++j) walker.advance(0.02);
    vehicle = testing::state_on(result.trajectory, now_s + 0.1);
  }
  EXPECT_EQ(allocated, 0);
}

}  // namespace
}  // namespace foretrack
