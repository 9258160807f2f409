// SPDX-License-Identifier: Apache-2.0
#include "services/files/config/load_scenario.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/simulator/simulate.hpp"
#include "tests/support/error_of.hpp"

namespace foretrack {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class LoadScenario : public testing::Test {
 protected:
  LoadScenario() : folder_(fs::temp_directory_path() / "foretrack_load_scenario") {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~LoadScenario() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  Scenario load(const std::string& text, const ScenarioOverrides& overrides = {}) {
    return load_scenario(write("case.yaml", text), overrides);
  }
  std::string error_of(const std::string& text) {
    return foretrack::error_of([&] { load(text); });
  }

  fs::path folder_;
};

constexpr const char* kWhole = R"(
world:
  bounds_m: [-20, -20, 0, 20, 20, 5]
  boxes: [{min_m: [1, 2, 0], max_m: [2, 3, 4]}]
  cylinders: [{center_m: [5, 5], radius_m: 0.5, height_m: 4}]
  generator: {kind: boxes, count: 12, seed: 510}
target:
  route_m: [[0, 0], [6, 0], [6, 8]]
  speed_m_s: 1.25
  acceleration_m_s2: 2.5
  stops: [{at_s: 12.0, for_s: 2.0}]
  height_m: 1.8
  shoulder_lead_s: -0.2
  shoulder_offset_rad: 3.1
  shoulder_sway_rad: 0.7
  shoulder_sway_hz: 0.6
vehicle: {position_m: [-2, 0, 1.5], yaw_rad: 0.5}
sensors:
  {landmark_noise_px: 1.0, depth_noise_m: 0.03, delay_s: 0.06, dropout: 0.1, flip_share: 0.3, fov_gated: false}
wind: {mean_m_s: [1, 2, 0], gust_m_s: 0.5}
map: depth
duration_s: 42
seed: 7
)";

TEST_F(LoadScenario, ReadsEveryKey) {
  const Scenario s = load(kWhole);
  EXPECT_EQ(s.name, "case");
  EXPECT_EQ(s.world.max_m, Vec3(20, 20, 5));
  ASSERT_EQ(s.world.boxes.size(), 1u);
  EXPECT_EQ(s.world.boxes[0].max_m, Vec3(2, 3, 4));
  ASSERT_EQ(s.world.cylinders.size(), 1u);
  EXPECT_EQ(s.world.cylinders[0].height_m, 4.0);
  EXPECT_EQ(s.generator.kind, WorldKind::kBoxes);
  EXPECT_EQ(s.generator.count, 12);
  EXPECT_EQ(s.generator.seed, 510u);
  ASSERT_EQ(s.target.route_m.size(), 3u);
  EXPECT_EQ(s.target.route_m[2], Vec2(6, 8));
  EXPECT_EQ(s.target.speed_m_s, 1.25);
  EXPECT_EQ(s.target.person.acceleration_m_s2, 2.5);
  ASSERT_EQ(s.target.person.stops.size(), 1u);
  EXPECT_EQ(s.target.person.stops[0].for_s, 2.0);
  EXPECT_EQ(s.target.person.height_m, 1.8);
  EXPECT_EQ(s.target.person.shoulder_lead_s, -0.2);
  EXPECT_EQ(s.target.person.shoulder_offset_rad, 3.1);
  EXPECT_EQ(s.target.person.shoulder_sway_rad, 0.7);
  EXPECT_EQ(s.target.person.shoulder_sway_hz, 0.6);
  EXPECT_EQ(s.landmark_camera.flip_share, 0.3);
  EXPECT_EQ(*s.vehicle_enu_m, Vec3(-2, 0, 1.5));
  EXPECT_EQ(s.vehicle_yaw_rad, 0.5);
  EXPECT_EQ(s.landmark_camera.noise_px, 1.0);
  EXPECT_EQ(s.landmark_camera.delay_s, 0.06);
  EXPECT_EQ(s.landmark_camera.dropout, 0.1);
  EXPECT_FALSE(s.landmark_camera.fov_gated);
  EXPECT_EQ(s.depth_camera.noise_m, 0.03);
  EXPECT_EQ(s.wind.mean_enu_m_s, Vec3(1, 2, 0));
  EXPECT_EQ(s.map, MapSource::kDepth);
  EXPECT_EQ(s.duration_s, 42.0);
  EXPECT_EQ(s.seed, 7u);
}

TEST_F(LoadScenario, BystandersWalkStopAndGoRound) {
  const Scenario s = load(R"(
bystanders:
  - {route_m: [[1, 2], [3, 2]], loop: true, speed_m_s: 0.8, height_m: 1.2, start_s: 0.5}
  - {route_m: [[0, 4]], acceleration_m_s2: 2, stops: [{at_s: 3, for_s: 1}]}
)");
  ASSERT_EQ(s.bystanders.size(), 2u);
  EXPECT_TRUE(s.bystanders[0].loop);
  EXPECT_EQ(s.bystanders[0].speed_m_s, 0.8);
  EXPECT_EQ(s.bystanders[0].walk.height_m, 1.2);
  EXPECT_EQ(s.bystanders[0].walk.start_s, 0.5);
  EXPECT_FALSE(s.bystanders[1].loop);
  EXPECT_EQ(s.bystanders[1].walk.height_m, 1.75);
  EXPECT_EQ(s.bystanders[1].walk.acceleration_m_s2, 2.0);
  ASSERT_EQ(s.bystanders[1].walk.stops.size(), 1u);
  EXPECT_EQ(s.bystanders[1].walk.stops[0].at_s, 3.0);
}

TEST_F(LoadScenario, AnOperatorsOrdersComeInTheOrderOfTheirTimes) {
  const Scenario s = load(R"(
orders:
  - {at_s: 9, follow: 2}
  - {at_s: 4, distance_m: 3, bearing_rad: -1.5, circling_rad_s: 0.2}
)");
  ASSERT_EQ(s.orders.size(), 2u);
  EXPECT_EQ(s.orders[0].framing,
            (Framing{.distance_m = 3.0, .bearing_rad = -1.5, .circling_rad_s = 0.2}));
  EXPECT_FALSE(s.orders[0].follow);
  EXPECT_EQ(s.orders[1].at_s, 9.0);
  EXPECT_EQ(s.orders[1].follow, 2u);
}

TEST_F(LoadScenario, StagesAnEncounterFromItsSeed) {
  const auto encounter = [&](std::uint64_t seed) {
    ScenarioOverrides o;
    o.seed = seed;
    o.settings = {"encounter=cross_before", "target.speed_m_s=2"};
    return load("encounter: head_on\nduration_s: 10\n", o);
  };
  const Scenario a = encounter(3), b = encounter(3), c = encounter(4);
  ASSERT_TRUE(a.encounter);
  EXPECT_EQ(a.encounter->kind, EncounterKind::kCrossBefore);
  ASSERT_FALSE(a.bystanders.empty());
  EXPECT_EQ(a.bystanders[0].speed_m_s, 2.0);
  EXPECT_EQ(a.bystanders[0].route_m, b.bystanders[0].route_m);
  EXPECT_NE(a.bystanders[0].route_m, c.bystanders[0].route_m);
}

TEST_F(LoadScenario, AnEmptyFileAndEmptyListsGiveTheDefaults) {
  EXPECT_EQ(load("").duration_s, Scenario{}.duration_s);
  const Scenario s = load("world: {boxes: [], cylinders: []}\ntarget: {route_m: [], stops: []}\n");
  EXPECT_TRUE(s.world.boxes.empty());
  EXPECT_EQ(s.target.speed_m_s, TargetSpec{}.speed_m_s);
  EXPECT_FALSE(s.vehicle_enu_m);
}

TEST_F(LoadScenario, NamesEveryFaultAtOnceWithItsLineAndKey) {
  const std::string error = error_of(R"(world:
  generator: {kind: maze}
target:
  speed_m_s: fast
  route_m: [[0, 0], [1]]
sensors: {dropout: 1.5, colour: red}
map: guessed
seed: -4
)");
  EXPECT_THAT(
      error,
      AllOf(HasSubstr("case.yaml:2: world.generator.kind: is 'maze', expected one of"),
            HasSubstr("case.yaml:4: target.speed_m_s: is 'fast'"),
            HasSubstr("case.yaml:5: target.route_m: a point is a list"),
            HasSubstr("case.yaml:6: sensors.dropout: is '1.5'"),
            HasSubstr("case.yaml:6: sensors.colour: unknown key; known are"),
            HasSubstr("case.yaml:7: map: is 'guessed'"), HasSubstr("case.yaml:8: seed: is '-4'")));
}

TEST_F(LoadScenario, RefusesWhatCannotBe) {
  const std::pair<const char*, const char*> cases[] = {
      {"duration_s: .nan\n", "duration_s: is '.nan'"},
      {"duration_s: 0\n", "expected a number in"},
      {"wrold: {}\n", "wrold: unknown key"},
      {"seed: 1\nseed: 2\n", "seed: given twice"},
      {"world: [1, 2]\n", "world: is a list, expected a mapping"},
      {"[1, 2]\n", "the document: is a list"},
      {"world: {bounds_m: [0, 0, 0, 1, 1]}\n", "bounds_m: is a list, expected a list of 6 numbers"},
      {"world: {bounds_m: [0, 0, 0, 1, -1, 1]}\n", "greatest corner must exceed"},
      {"world: {boxes: [{min_m: [0, 0, 0]}]}\n", "min_m and max_m are needed"},
      {"world: {boxes: 3}\n", "boxes: is '3', expected a list"},
      {"world: {cylinders: [{radius_m: 1}]}\n", "cylinders[0].center_m: is needed"},
      {"world: {generator: {count: 1.5}}\n", "count: is '1.5', expected a whole number"},
      {"target: {route_m: [[0, 0], [99, 0]]}\n", "(99, 0) is outside world.bounds_m"},
      {"target: {route_m: [[0, 0]], track: {file: x}}\n", "either route_m or track"},
      {"target: {track: {pedestrian: 1}}\n", "target.track.file: is needed"},
      {"target: {track: {file: nowhere.txt}}\n", "cannot read"},
      {"encounter: stroll\n", "encounter: is 'stroll', expected one of"},
      {"encounter: group\nvehicle: {yaw_rad: 1}\n", "vehicle: an encounter has its own"},
      {"encounter: group\ntarget: {route_m: [[0, 0]]}\n", "an encounter has its own route"},
      {"bystanders: [{loop: true}]\n", "route_m: is needed"},
      {"orders: [{follow: 1, height_m: 2}]\n", "either whom to follow or a framing"},
      {"sensors: {fov_gated: perhaps}\n", "expected true or false"},
      {"seed: [\n", "not YAML"},
  };
  for (const auto& [text, expected] : cases)
    EXPECT_THAT(error_of(text), AllOf(HasSubstr("case.yaml"), HasSubstr(expected))) << text;
}

TEST_F(LoadScenario, ATrackLiesBesideTheScenarioAndSetsTheBounds) {
  write("walk.txt", "0 5 10 40\n10 5 10.5 40\n20 5 11 41\n");
  const Scenario s =
      load("target: {track: {file: walk.txt, format: xy, pedestrian: 5, rate_hz: 25}}\n");
  ASSERT_EQ(s.target.track.size(), 3u);
  EXPECT_NEAR(s.target.track[2].time_s, 0.8, 1e-12);
  EXPECT_EQ(s.world.min_m, Vec3(2, 32, 0));
  EXPECT_NO_THROW(make_simulator(s));
}

TEST_F(LoadScenario, OverridesComeLast) {
  const std::string track = write("other.xy", "0 1 0 0\n10 1 1 0\n0 2 5 5\n10 2 6 5\n");
  ScenarioOverrides o;
  o.seed = 99;
  o.map = MapSource::kKnown;
  o.duration_s = 3.0;
  EXPECT_EQ(load(kWhole, o).seed, 99u);
  EXPECT_EQ(load(kWhole, o).generator.seed, 510u) << "the file gives the generator's own seed";
  EXPECT_EQ(load("world: {generator: {kind: boxes}}\n", o).generator.seed, 99u);
  EXPECT_EQ(load(kWhole, o).map, MapSource::kKnown);
  EXPECT_EQ(load(kWhole, o).duration_s, 3.0);
  o.track_file = track;
  o.pedestrian = 2;
  EXPECT_EQ(load(kWhole, o).target.track[0].position_m, Vec2(5, 5));
}

TEST(ShippedScenarios, AllLoadAndFly) {
  const auto names = scenario_names();
  EXPECT_THAT(names, testing::IsSupersetOf({"t_intersection", "street_blocks", "dense_boxes",
                                            "deceleration", "depth_t_intersection"}));
  for (const auto& name : names) {
    SCOPED_TRACE(name);
    SimulatorState state = make_simulator(load_scenario(name));
    for (int i = 0; i < 10; ++i) simulate(state, {}, 0.01);
    // The whole walk stays inside the bounds and clear of what stands there.
    const Walk& walk = state.person.walk;
    for (double t = 0.0; t < walk.duration_s(); t += 0.1) {
      ASSERT_TRUE(
          state.world.contains({walk.at(t).position_m.x(), walk.at(t).position_m.y(), 1.0}));
      ASSERT_GE(ground_clearance_m(state.world, walk.at(t).position_m), 0.3);
    }
  }
}

TEST(ShippedScenarios, AnUnknownNameListsThoseThatExist) {
  try {
    load_scenario("no_such_place");
    FAIL() << "no error";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("no_such_place"), HasSubstr("t_intersection")));
  }
}

TEST_F(LoadScenario, SettingsCountAsIfTheFileHadSaidSo) {
  ScenarioOverrides overrides;
  overrides.settings = {"target.speed_m_s=1.75", "sensors.delay_s=0.2", "wind.mean_m_s=[1, 0, 0]",
                        "sensors.fov_gated=false"};
  const Scenario s = load("target: {speed_m_s: 1.0, height_m: 1.9}\n", overrides);
  EXPECT_EQ(s.target.speed_m_s, 1.75);
  EXPECT_EQ(s.target.person.height_m, 1.9);
  EXPECT_EQ(s.landmark_camera.delay_s, 0.2);
  EXPECT_EQ(s.wind.mean_enu_m_s.x(), 1.0);
  EXPECT_FALSE(s.landmark_camera.fov_gated);
}

TEST_F(LoadScenario, ASettingThatCannotBeIsAnErrorThatNamesIt) {
  const auto error = [&](const std::string& setting) {
    ScenarioOverrides overrides;
    overrides.settings = {setting};
    try {
      load("target: {speed_m_s: 1.0}\n", overrides);
    } catch (const std::invalid_argument& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(error("target.speed_m_s"), HasSubstr("expected KEY=VALUE"));
  EXPECT_THAT(error("=3"), HasSubstr("expected KEY=VALUE"));
  EXPECT_THAT(error("target.sped=3"), HasSubstr("target.sped: unknown key"));
  EXPECT_THAT(error("target.speed_m_s.x=3"), HasSubstr("setting 'target.speed_m_s.x=3'"));
  EXPECT_THAT(error("target.speed_m_s=[1"), HasSubstr("setting"));
  EXPECT_THAT(error("target.speed_m_s=99"), HasSubstr("target.speed_m_s"));
}

TEST_F(LoadScenario, RandomStopsComeFromTheSeedWithinTheirRanges) {
  const std::string text =
      "target: {random_stops: {every_s: [4, 6], for_s: [1, 2]}}\nduration_s: 60\n";
  ScenarioOverrides one, two;
  one.seed = 1;
  two.seed = 2;
  const auto stops = load(text, one).target.person.stops;
  ASSERT_GE(stops.size(), 6u);
  for (std::size_t i = 1; i < stops.size(); ++i) {
    const double walk_s = stops[i].at_s - stops[i - 1].at_s - stops[i - 1].for_s;
    EXPECT_GE(walk_s, 4.0);
    EXPECT_LE(walk_s, 6.0);
    EXPECT_GE(stops[i].for_s, 1.0);
    EXPECT_LE(stops[i].for_s, 2.0);
  }
  EXPECT_EQ(load(text, one).target.person.stops[0].at_s, stops[0].at_s);
  EXPECT_NE(load(text, two).target.person.stops[0].at_s, stops[0].at_s);
  EXPECT_THAT(error_of("target: {random_stops: {every_s: [6, 4]}}\n"), HasSubstr("every_s"));
}

Scenario with_vehicles(const char* name, int count) {
  ScenarioOverrides overrides;
  overrides.vehicles = count;
  return load_scenario(name, overrides);
}

TEST_F(LoadScenario, TakesSoManyVehiclesAsTheCommandLineSays) {
  const auto names = [](int count) {
    const Scenario fleet = with_vehicles("fleet_blocks", count);
    std::vector<std::string> out;
    for (const FleetVehicle& vehicle : fleet.vehicles) out.push_back(vehicle.name);
    return out;
  };
  EXPECT_EQ(names(2), (std::vector<std::string>{"uav1", "uav2"}));
  EXPECT_EQ(names(4), (std::vector<std::string>{"uav1", "uav2", "uav3", "uav4"}));
  EXPECT_EQ(with_vehicles("open_field", 2).vehicles.size(), 2u);
  EXPECT_THROW(with_vehicles("open_field", 17), std::invalid_argument);
}

}  // namespace
}  // namespace foretrack
