// SPDX-License-Identifier: Apache-2.0
#include "core/tracker/tracker.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

#include "core/safety/command_of.hpp"
#include "core/simulator/simulate.hpp"
#include "tests/support/count_allocations.hpp"

namespace foretrack {
namespace {

constexpr double kTick_s = 0.01;
constexpr double kFrame_s = 0.03;

World arena() {
  return {.min_m = {-6, -6, 0}, .max_m = {10, 6, 4}, .boxes = {}, .cylinders = {}};
}

/// A hovering vehicle, a person who walks along x, seen as a position every 30 ms, and a tracker
/// that nobody obeys.
struct Scene {
  TrackerParams params;
  std::optional<TrackerState> state;
  GridMap map = known_map(arena(), 0.2);
  const GridMap* known = &map;
  double camera_delay_s = 0.0;
  double seen_until_s = 1e9;
  int ticks = 0;
  const DepthImage* depth = nullptr;

  double now_s() const { return kTick_s * ticks; }
  static Vec3 person_at(double time_s) { return {1.0 * time_s, 0.0, 1.2}; }

  VehicleState vehicle() const {
    VehicleState v;
    v.stamp_s = now_s();
    v.position_enu_m = {-2.0, 0.0, 1.5};
    return v;
  }

  std::optional<TargetObservation> observation() const {
    const double stamp_s = now_s() - camera_delay_s;
    const bool is_due = std::lround(stamp_s / kTick_s) % std::lround(kFrame_s / kTick_s) == 0;
    if (!is_due || stamp_s < 0.0 || stamp_s > seen_until_s) return std::nullopt;
    TargetObservation o;
    o.kind = TargetObservation::Kind::kPosition;
    o.stamp_s = stamp_s;
    o.position_enu_m = person_at(stamp_s);
    o.covariance_m2 = 1e-4 * Mat3::Identity();
    return o;
  }

  TrackerOutput tick() {
    if (!state) state.emplace(params);
    ++ticks;
    const auto seen = observation();
    TrackerInput input{.now_s = now_s(),
                       .vehicle = vehicle(),
                       .autopilot = {.stamp_s = now_s(), .armed = true, .offboard = true},
                       .observation = seen ? &*seen : nullptr,
                       .depth = depth,
                       .known_map = known};
    return step(*state, input, params);
  }

  TrackerOutput run(double for_s) {
    TrackerOutput out;
    for (int i = 0; i < std::lround(for_s / kTick_s); ++i) out = tick();
    return out;
  }
};

TEST(Tracker, WithoutAMapItPerceivesButNeitherPredictsNorPlans) {
  Scene scene;
  scene.known = nullptr;
  const TrackerOutput out = scene.run(0.5);
  EXPECT_EQ(out.target.status, TrackStatus::kTracking);
  EXPECT_EQ(out.map, nullptr);
  EXPECT_EQ(out.prediction, nullptr);
  EXPECT_EQ(out.plan, nullptr);
  EXPECT_FALSE(out.planned);
}

TEST(Tracker, WhatIsSeenIsPredictedAndPlannedForInTheSameStep) {
  Scene scene;
  scene.run(0.5);
  TrackerOutput out;
  do out = scene.tick();
  while (!out.planned);
  const double now_s = scene.now_s();
  EXPECT_EQ(out.target.stamp_s, now_s);
  EXPECT_NEAR((out.target.position_enu_m - Scene::person_at(now_s)).norm(), 0.0, 0.05);
  EXPECT_EQ(out.prediction->prediction.stamp_s, now_s);
  EXPECT_EQ(out.prediction->prediction.status, PredictionStatus::kOk);
  EXPECT_EQ(out.plan->trajectory.stamp_s, now_s);
  EXPECT_EQ(out.plan->trajectory.status, PlanStatus::kFresh);
  EXPECT_GE(out.plan->trajectory.start_s, now_s);
}

TEST(Tracker, PlansOnceInAPlanPeriod) {
  for (const int ticks : {1, 3, 10}) {
    Scene scene;
    scene.params.planning.horizon.plan_period_s = ticks * kTick_s;
    for (int i = 0; i < 60; ++i) EXPECT_EQ(scene.tick().planned, i % ticks == 0) << i;
  }
}

TEST(Tracker, PlansAsSoonAsThereIsAMap) {
  Scene scene;
  scene.known = nullptr;
  scene.run(1.0);
  scene.known = &scene.map;
  EXPECT_TRUE(scene.tick().planned);
}

// The camera's delay is above tracking_age_s: by the age of what it shows alone, the target would
// never be tracked.
TEST(Tracker, ACameraThatIsAlwaysLateDoesNotMakeTheTargetAHiddenOne) {
  Scene scene;
  scene.camera_delay_s = 0.4;
  scene.seen_until_s = 2.0;
  ASSERT_GT(scene.camera_delay_s, scene.params.perception.tracking_age_s);
  scene.run(0.5);
  while (scene.now_s() < 2.4) EXPECT_EQ(scene.tick().target.status, TrackStatus::kTracking);
  scene.run(scene.params.perception.tracking_age_s - 0.05);
  EXPECT_EQ(scene.tick().target.status, TrackStatus::kTracking);
  EXPECT_EQ(scene.run(0.1).target.status, TrackStatus::kCoasting);
  EXPECT_EQ(scene.run(2.0).target.status, TrackStatus::kLost);
}

TEST(Tracker, TheEstimateIsOfNowHoweverLateTheCamera) {
  Scene scene;
  scene.camera_delay_s = 0.2;
  const TrackerOutput out = scene.run(2.0);
  EXPECT_EQ(out.target.stamp_s, scene.now_s());
  EXPECT_NEAR((out.target.position_enu_m - Scene::person_at(scene.now_s())).norm(), 0.0, 0.03);
}

// A wall 3 m before the camera, and the ground.
DepthImage depth_of_a_wall(const VehicleState& vehicle, double person_x_m) {
  World world = arena();
  world.boxes.push_back({{1.0, -5.0, 0.0}, {1.4, 5.0, 4.0}});
  DepthCamera camera = make_depth_camera({.noise_m = 0.0}, 1);
  PersonState person;
  person.position_enu_m = {person_x_m, 0.0, torso_height_m(1.75)};
  render(camera, world, vehicle, person, 1.75);
  return camera.image;
}

TEST(Tracker, BuildsTheMapFromDepthImagesWithoutTheTarget) {
  Scene scene;
  scene.known = nullptr;
  scene.run(0.1);
  VehicleState next = scene.vehicle();
  next.stamp_s += kTick_s;
  const DepthImage image = depth_of_a_wall(next, Scene::person_at(next.stamp_s).x());
  scene.depth = &image;
  const TrackerOutput out = scene.tick();
  ASSERT_EQ(out.map, &scene.state->mapping.map);
  EXPECT_EQ(out.map->stamp_s, image.stamp_s);
  EXPECT_TRUE(out.map->is_occupied({1.0, 1.5, 1.5}));
  EXPECT_FALSE(out.map->is_occupied(out.target.position_enu_m));
  EXPECT_TRUE(out.planned);
}

TEST(Tracker, AKnownMapGoesBeforeOneThatWasBuilt) {
  Scene scene;
  scene.run(0.1);
  VehicleState next = scene.vehicle();
  next.stamp_s += kTick_s;
  const DepthImage image = depth_of_a_wall(next, 5.0);
  scene.depth = &image;
  EXPECT_EQ(scene.tick().map, &scene.map);
  scene.depth = nullptr;
  scene.known = nullptr;
  EXPECT_EQ(scene.tick().map, &scene.state->mapping.map) << "it was built all the same";
}

TEST(Tracker, ADepthOfTheTorsoCorrectsTheRangeOfLandmarks) {
  const VehicleState vehicle{.stamp_s = 1.0, .position_enu_m = {0.0, 0.0, 1.5}};
  PersonState person;
  person.position_enu_m = {3.0, 0.0, torso_height_m(1.75)};
  LandmarkCameraParams exact;
  exact.noise_px = exact.joint_noise_m = exact.delay_s = 0.0;
  LandmarkCamera camera = make_landmark_camera(exact, 1);
  const auto seen = observe(camera, {}, vehicle, person, 1.75);
  ASSERT_TRUE(seen);
  const auto range_m = [&](double torso_depth_m) {
    const TrackerParams params;
    TrackerState state(params);
    const TrackerInput input{.now_s = 1.0,
                             .vehicle = vehicle,
                             .autopilot = {},
                             .observation = &*seen,
                             .torso_depth_m = torso_depth_m};
    return step(state, input, params).target.position_enu_m.x();
  };
  const TrackerParams params;
  EXPECT_NEAR(range_m(std::numeric_limits<double>::quiet_NaN()), 3.0, 0.02);
  EXPECT_NEAR(range_m(2.6), 2.6 + params.perception.torso_half_depth_m, 0.02);
}

TEST(Tracker, PredictionAndPlanAreGivenOutInTheStepThatMadeThemOnly) {
  Scene scene;
  for (int i = 0; i < 20; ++i) {
    const TrackerOutput out = scene.tick();
    EXPECT_EQ(out.plan != nullptr, out.planned);
    EXPECT_EQ(out.prediction != nullptr, out.planned);
  }
}

struct Flown {
  std::vector<double> numbers;
  void add(const TrackerOutput& out) {
    for (const double x : out.target.position_enu_m) numbers.push_back(x);
    if (out.planned) {
      for (const auto& belief : out.prediction->intention.beliefs)
        numbers.push_back(belief.probability);
      for (const auto& piece : out.plan->trajectory.pieces)
        for (const double c : piece.coefficients.reshaped()) numbers.push_back(c);
    }
    numbers.push_back(out.gate.setpoint ? out.gate.setpoint->position_enu_m.x() : -1e9);
  }
};

/// The whole loop with a simulated vehicle, camera, flight controller and person. An operator
/// orders to start at a time.
template <class Watch>
void fly(double for_s, double start_s, Watch&& watch) {
  Scenario scenario;
  scenario.world = arena();
  scenario.target.route_m = {{-1, 0}, {3, 0}, {3, 4}};
  SimulatorState simulator = make_simulator(scenario);
  const GridMap map = known_map(simulator.world, 0.2);
  const TrackerParams params;
  TrackerState tracker(params);
  AutopilotInput obeyed;
  bool ordered = false;
  for (int i = 0; i < std::lround(for_s / kTick_s); ++i) {
    const SimulatorOutput& s = simulate(simulator, obeyed, kTick_s);
    const MissionCommand start{.id = 1, .stamp_s = s.now_s, .order = MissionOrder::kStart};
    const bool now = s.now_s >= start_s && !std::exchange(ordered, s.now_s >= start_s);
    const TrackerInput input{.now_s = s.now_s,
                             .vehicle = s.vehicle,
                             .autopilot = s.autopilot,
                             .observation = s.observation ? &*s.observation : nullptr,
                             .known_map = &map,
                             .command = now ? &start : nullptr};
    const TrackerOutput out = step(tracker, input, params);
    obeyed = {.heartbeat = out.gate.heartbeat,
              .setpoint = out.gate.setpoint,
              .command = command_of(out.gate.request, 1)};
    watch(s, out);
  }
}

TEST(Tracker, NothingIsCommandedBeforeTheStartOrderThoughPlansAreMade) {
  int plans = 0;
  fly(1.0, 2.0, [&](const SimulatorOutput& s, const TrackerOutput& out) {
    plans += out.planned;
    EXPECT_FALSE(out.gate.setpoint) << s.now_s;
    EXPECT_FALSE(out.gate.heartbeat) << s.now_s;
    EXPECT_EQ(out.gate.request, AutopilotRequest::kNone) << s.now_s;
    EXPECT_EQ(out.gate.phase, MissionPhase::kIdle) << s.now_s;
  });
  EXPECT_GT(plans, 30);
}

TEST(Tracker, FollowsAWalkingPersonFromTheStartOrderOn) {
  double tracks_s = 0.0, farthest_m = 0.0;
  fly(7.0, 0.5, [&](const SimulatorOutput& s, const TrackerOutput& out) {
    if (out.gate.mode == SafetyMode::kTrack && out.gate.setpoint && tracks_s == 0.0)
      tracks_s = s.now_s;
    if (s.now_s < 3.0) return;
    const Sight sight = sight_of(arena(), CameraModel(), s.vehicle, s.target, 1.75, 8.0);
    EXPECT_TRUE(sight.visible()) << s.now_s;
    farthest_m =
        std::max(farthest_m, distance_xy(s.vehicle.position_enu_m, s.target.position_enu_m));
  });
  EXPECT_GT(tracks_s, 0.5);
  EXPECT_LT(tracks_s, 2.5);
  EXPECT_LT(farthest_m, 4.5) << "the person walks 6 m away from where the vehicle starts";
}

TEST(Tracker, TheSameInputsGiveTheSameOutputs) {
  std::array<Flown, 2> flights;
  for (Flown& flown : flights)
    fly(3.0, 0.0, [&](const SimulatorOutput&, const TrackerOutput& out) { flown.add(out); });
  EXPECT_GT(flights[0].numbers.size(), 3000U);
  EXPECT_EQ(flights[0].numbers, flights[1].numbers);
}

TEST(Tracker, AllocatesNothingAfterWarmUp) {
  Scene scene;
  scene.run(1.0);
  const long before = allocation_count();
  const TrackerOutput out = scene.run(1.0);
  EXPECT_EQ(allocation_count(), before);
  EXPECT_EQ(out.target.status, TrackStatus::kTracking);
}

}  // namespace
}  // namespace foretrack
