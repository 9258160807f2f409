// SPDX-License-Identifier: Apache-2.0
#include "services/offline/experiments/bench.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "services/files/config/load_params.hpp"
#include "services/files/config/load_scenario.hpp"
#include "services/offline/flight/fly.hpp"
#include "tests/support/error_of.hpp"

namespace foretrack {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

BenchRequest small_request() {
  BenchRequest request;
  request.experiments = {experiment_named("deceleration")};
  request.experiments[0].duration_s = 12.0;
  request.methods = {"intention", "cv"};
  request.maps = {MapSource::kKnown};
  request.seed = 101;
  request.runs = 2;
  return request;
}

class Bench : public testing::Test {
 protected:
  Bench() : folder_(fs::temp_directory_path() / "foretrack_bench_test") {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Bench() override { fs::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  nlohmann::json summary() const {
    std::ifstream in(folder_ / "out" / "summary.json");
    return nlohmann::json::parse(in);
  }
  fs::path folder_;
};

std::string error_of(const BenchRequest& request) {
  return foretrack::error_of([&] { list_jobs(request); });
}

TEST_F(Bench, WritesCellsWithTheseFieldsAndNoOthers) {
  run_bench(small_request(), {.threads = 1, .out = folder_ / "out", .logs = KeptLogs::kAll});
  const auto cells = summary()["cells"];
  ASSERT_EQ(cells.size(), 2u);
  std::vector<std::string> keys;
  for (const auto& item : cells[0].items()) keys.push_back(item.key());
  EXPECT_THAT(keys, testing::UnorderedElementsAre(
                        "experiment", "method", "map", "target_speed_m_s", "events", "successes",
                        "success_low", "success_high", "failure_rate", "occlusion_rate",
                        "fov_loss_rate", "near_rate", "min_distance_m", "band_share", "collisions",
                        "min_clearance_m", "plan_ms", "seed", "log_sha256"));
  EXPECT_EQ(cells[0]["method"], "intention");
  EXPECT_EQ(cells[0]["seed"], 101);
  EXPECT_EQ(cells[0]["target_speed_m_s"], 2.0);
  EXPECT_GT(cells[0]["events"], 0);
  EXPECT_EQ(cells[0]["events"], cells[1]["events"]);  // the same walks
  EXPECT_EQ(cells[0]["log_sha256"].get<std::string>().size(), 64u);
  EXPECT_NE(cells[0]["log_sha256"], cells[1]["log_sha256"]);
  EXPECT_GT(cells[0]["plan_ms"]["p50"], 0.0);
  EXPECT_EQ(summary()["comparisons"].size(), 1u);
  EXPECT_TRUE(fs::exists(folder_ / "out/logs/deceleration/cv-known-2.0-deceleration-102.csv.gz"));
  EXPECT_TRUE(fs::exists(folder_ / "out/flights.csv"));
  EXPECT_TRUE(fs::exists(folder_ / "out/details.json"));
}

TEST_F(Bench, TheSameSeedGivesTheSameHashesOnAnyNumberOfThreads) {
  const auto hashes = [](int threads, std::uint64_t seed) {
    BenchRequest request = small_request();
    request.maps = {MapSource::kKnown, MapSource::kDepth};
    request.experiments[0].duration_s = 4.0;
    request.seed = seed;
    std::vector<std::string> all;
    for (const auto& cell : run_bench(request, {.threads = threads}).cells)
      all.push_back(cell.log_sha256);
    return all;
  };
  const auto alone = hashes(1, 101);
  EXPECT_EQ(alone, hashes(4, 101));
  EXPECT_NE(alone, hashes(4, 103));
}

TEST_F(Bench, SumsUpWhatWasFlownUntilItWasStopped) {
  std::size_t done = 0;
  BenchOptions options{.threads = 1, .out = folder_ / "out", .logs = KeptLogs::kNone};
  options.progress = [&](const BenchProgress& progress) { done = progress.done; };
  options.stopped = [&] { return done >= 3; };
  const BenchResults r = run_bench(small_request(), options);  // of four flights
  ASSERT_EQ(r.jobs.size(), 3u);
  ASSERT_EQ(r.records.size(), 3u);
  std::size_t runs = 0;
  for (const auto& cell : r.cells) runs += cell.runs.size();
  EXPECT_EQ(runs, 3u);
  EXPECT_EQ(summary()["cells"].size(), 2u);
}

TEST_F(Bench, AFlightOfABenchIsTheOneThatItsCommandFlies) {
  BenchRequest request = small_request();
  request.experiments[0].duration_s = 3.0;
  const FlightJob job = list_jobs(request).at(1);
  EXPECT_EQ(job.command,
            "foretrack fly --scenario deceleration --seed 102 --map known --for 3 "
            "--set target.speed_m_s=2 --params intention --out flights/replay");
  ScenarioOverrides overrides;
  overrides.seed = 102;
  overrides.map = MapSource::kKnown;
  overrides.duration_s = 3.0;
  overrides.settings = {"target.speed_m_s=2"};
  const FlightResult flight =
      fly(load_scenario("deceleration", overrides), load_params(find_params("intention")));
  EXPECT_EQ(run_job(job).log_sha256, sha256_of(csv_of(flight.rows)));
}

TEST_F(Bench, FliesOwnWorldsAtTheirOwnSpeed) {
  BenchRequest request = small_request();
  request.scenario_files = {write("yard.yaml", R"(
world: {boxes: [{min_m: [1, 1, 0], max_m: [2, 2, 3]}]}
target: {route_m: [[-8, 0], [3, 0], [3, 6]], speed_m_s: 1.2}
duration_s: 3
)")};
  request.runs = 1;
  const auto cells = run_bench(request, {.threads = 2}).cells;
  ASSERT_EQ(cells.size(), 2u);
  EXPECT_NEAR(cells[0].target_speed_m_s, 1.2, 0.25);  // with the start
  EXPECT_NEAR(cells[0].duration_s, 3.0, 1e-9);
}

TEST_F(Bench, FollowsEveryPedestrianOfATrackFileThatWalksLongEnough) {
  std::string rows;
  for (int id = 1; id <= 3; ++id)
    for (int k = 0; k <= (id == 3 ? 5 : 15); ++k)  // 0.4 s a row: 6 s, 6 s, 2 s
      rows += std::to_string(10 * k) + " " + std::to_string(id) + " " + std::to_string(0.5 * k) +
              " 0 " + std::to_string(id) + " 1.25 0 0\n";
  BenchRequest request = small_request();
  request.experiments = {experiment_named("real_tracks")};
  request.methods = {"intention"};
  request.runs = 0;
  request.track_files = {write("obsmat.txt", rows)};
  const BenchResults r = run_bench(request, {.threads = 2});
  ASSERT_EQ(r.jobs.size(), 2u);
  EXPECT_EQ(r.cells[0].events, 2);
  EXPECT_NEAR(r.cells[0].target_speed_m_s, 1.25, 0.1);
  const PathErrors e = r.cells[0].paths.means(
      PathWindows::kAll)[static_cast<std::size_t>(PathKind::kConstantVelocity)][1];
  EXPECT_GT(e.count, 20);
  EXPECT_LT(e.fde_m, 0.4);
}

TEST_F(Bench, ChestsDifferFromEachOtherAndAreFlownOnTheSameSeeds) {
  BenchRequest request = small_request();
  request.experiments = {experiment_named("chests")};
  request.methods = request.experiments[0].methods;
  request.runs = 1;
  const std::vector<FlightJob> jobs = list_jobs(request);
  ASSERT_EQ(jobs.size(), 2 * request.experiments[0].conditions.size());
  std::set<std::vector<std::string>> chests;
  for (const FlightJob& job : jobs) {
    EXPECT_EQ(job.overrides.seed, jobs[0].overrides.seed);
    chests.insert(job.overrides.settings);
  }
  EXPECT_EQ(chests.size(), request.experiments[0].conditions.size());
  EXPECT_EQ(jobs.back().cell.method, "filter");
}

TEST_F(Bench, OfRecordedPeopleTheChestDoesNotTellTheFutureUnlessTheExperimentSaysSo) {
  BenchRequest request = small_request();
  request.methods = {"intention"};
  request.runs = 1;
  for (const auto& [name, lead_s] : {std::pair{"real_tracks", 0.0}, {"real_tracks_chest", 0.3}}) {
    request.experiments = {experiment_named(name)};
    const FlightJob job = list_jobs(request).at(0);
    EXPECT_EQ(load_scenario(job.world, job.overrides).target.person.shoulder_lead_s, lead_s);
  }
}

TEST_F(Bench, EncountersAreStagedByKindAndSeedAndSummedUp) {
  BenchRequest request = small_request();
  request.experiments = {experiment_named("encounters")};
  request.experiments[0].duration_s = 5.5;
  std::erase_if(request.experiments[0].conditions,
                [](const Condition& c) { return c.name != "turn_back"; });
  request.methods = {"intention"};
  request.speeds_m_s = {1.5};
  request.runs = 1;
  const BenchResults r = run_bench(request, {.threads = 1, .out = folder_ / "out"});
  ASSERT_EQ(r.encounters.by_kind.size(), 1u);
  EXPECT_EQ(r.encounters.by_kind[0].name, "turn_back");
  EXPECT_GT(r.encounters.by_kind[0].encounters, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/encounters.json"));
  EXPECT_TRUE(fs::exists(folder_ / "out/encounters.csv"));
  EXPECT_THAT(r.jobs[0].command, HasSubstr("--scenario encounter --seed 101"));
  EXPECT_THAT(r.jobs[0].command, HasSubstr("--set encounter=turn_back"));
  request.seed = 0;
  EXPECT_EQ(list_jobs(request)[0].overrides.seed, kFirstEncounterSeed);
}

TEST_F(Bench, SaysWhatIsWrongBeforeAnythingFlies) {
  BenchRequest request = small_request();
  request.methods = {"clever"};
  EXPECT_THAT(error_of(request), HasSubstr("no parameter file or name 'clever'"));
  EXPECT_THAT(error_of(request), HasSubstr("intention"));
  request = small_request();
  request.scenario_files = {write("bad.yaml", "target: {sped_m_s: 1}\n")};
  EXPECT_THAT(error_of(request), HasSubstr("target.sped_m_s: unknown key"));
  request = small_request();
  request.experiments = {experiment_named("real_tracks")};
  request.track_files = {write("tracks.txt", "1 2 x\n")};
  EXPECT_THAT(error_of(request), HasSubstr("tracks.txt"));
  EXPECT_THAT(
      [] {
        try {
          experiment_named("turnning");
        } catch (const std::invalid_argument& error) {
          return std::string(error.what());
        }
        return std::string();
      }(),
      HasSubstr("there are turning, deceleration, t_intersection, real_tracks, stress, chests, "
                "real_tracks_chest, encounters, encounters_all_round, search, fleet and all"));
}

TEST(Experiments, AreEvaluatedOnSeedsThatNothingIsTunedOn) {
  EXPECT_GE(kFirstEvaluationSeed, 5000u);
  EXPECT_GE(kFirstEncounterSeed, 20001u);
  EXPECT_GE(kFirstFleetSeed, 50000u);
  EXPECT_EQ(experiments().size(), 11u);
}

}  // namespace
}  // namespace foretrack
