// SPDX-License-Identifier: Apache-2.0
// A whole flight, as `./run demo` starts it.
#include "services/launch/domain.hpp"
#include "tests/system/program.hpp"

namespace foretrack {
namespace {

TEST(Demo, FliesWithoutCollisionAndWritesACompleteSummary) {
  Folder folder;
  const auto out = folder.path / "flight";
  // At half speed, so that a busy machine keeps up.
  Program demo({"demo", "--headless", "--for", "9", "--speed", "0.5", "--out", out.string()},
               folder.path / "out");
  ASSERT_EQ(demo.wait(150.0), 0) << demo.output();
  for (const char* file : {"log.csv", "metrics.json", "summary.json", "flight.png",
                           "logs/simulator.log", "logs/safety_gate.log"})
    EXPECT_TRUE(std::filesystem::exists(out / file)) << file;

  const auto summary = Json::parse(text_of(out / "summary.json"));
  EXPECT_GT(summary["path_length_m"], 5.0);
  EXPECT_GT(summary["plans"], 100);
  EXPECT_EQ(summary["metrics"]["collisions"], 0);
  EXPECT_GE(summary["metrics"]["duration_s"], 8.0);  // and what the person waited
  EXPECT_GT(summary["metrics"]["min_distance_m"], 0.5);
  EXPECT_GT(summary["latency_ms"]["p50"], 0.0);
  EXPECT_GE(summary["latency_ms"]["p99"], summary["latency_ms"]["p50"]);
  EXPECT_GT(summary["stage_ms"]["plan"]["p50"], 0.0);
  for (const char* service :
       {"perception", "mapping", "prediction", "planning", "safety_gate", "simulator"}) {
    EXPECT_GT(summary["services"][service]["memory_bytes"], 1e6) << service;
    EXPECT_GT(summary["services"][service]["cpu_percent"], 0.0) << service;
    EXPECT_EQ(summary["services"][service]["restarts"], 0) << service;
  }
  EXPECT_GT(summary["onboard"]["memory_bytes"], 1e6);
  EXPECT_EQ(demo.output().find('\033'), std::string::npos) << "control codes without a terminal";
}

TEST(Demo, CtrlCEndsItWithinThreeSecondsAndLeavesNothing) {
  const FreeDomain domain;
  const std::string id = std::to_string(domain.id());
  Folder folder;
  Program up({"up", "--domain", id, "--out", folder.path.string()}, folder.path / "out");
  const std::vector<std::string> ours = {"--domain", id};
  ASSERT_TRUE(eventually([&] { return processes_with(ours).size() >= 6; }, 10.0)) << up.output();
  ASSERT_TRUE(eventually(
      [&] {
        return text_of(folder.path / "logs/safety_gate.log").find("runs for") != std::string::npos;
      },
      15.0));
  const auto files = shared_memory_of(processes_with(ours));
  const auto begin = std::chrono::steady_clock::now();
  up.send(SIGINT);
  ASSERT_NE(up.wait(10.0), -1);
  EXPECT_LT(Seconds(std::chrono::steady_clock::now() - begin).count(), 3.0);
  EXPECT_TRUE(processes_with(ours).empty());
  for (const auto& file : files) EXPECT_FALSE(std::filesystem::exists(file)) << file;
}

TEST(Demo, CtrlCDuringADemoStopsTheServicesAndKeepsWhatWasFlown) {
  const FreeDomain domain;
  const std::string id = std::to_string(domain.id());
  Folder folder;
  const auto out = folder.path / "flight";
  Program demo({"demo", "--headless", "--domain", id, "--out", out.string()}, folder.path / "out");
  ASSERT_TRUE(
      eventually([&] { return demo.output().find("gate track") != std::string::npos; }, 30.0))
      << demo.output();
  demo.send(SIGINT);
  const auto begin = std::chrono::steady_clock::now();
  const auto gone = [&] { return processes_with({"--use-sim-time", "--domain", id}).empty(); };
  EXPECT_TRUE(eventually(gone, 5.0));
  EXPECT_LT(Seconds(std::chrono::steady_clock::now() - begin).count(), 3.0);
  ASSERT_NE(demo.wait(60.0), -1);
  EXPECT_GT(Json::parse(text_of(out / "summary.json"))["plans"], 0);
}

TEST(Demo, RefusesAParameterThatDoesNotExist) {
  Folder folder;
  const auto file = folder.path / "bad.yaml";
  std::ofstream(file) << "planning: {no_such_parameter: 1}\n";
  for (const char* command : {"demo", "up"}) {
    Program program({command, "--params", file.string(), "--out", folder.path.string()},
                    folder.path / "out");
    EXPECT_EQ(program.wait(20.0), 2) << command;
    EXPECT_NE(program.output().find("no_such_parameter"), std::string::npos) << program.output();
  }
}

TEST(Demo, AKilledLauncherTakesTheServicesAlong) {
  const FreeDomain domain;
  const std::string id = std::to_string(domain.id());
  Folder folder;
  Program up({"up", "--domain", id, "--out", folder.path.string()}, folder.path / "out");
  const std::vector<std::string> services = {"--use-sim-time", "--domain", id};
  ASSERT_TRUE(eventually([&] { return processes_with(services).size() >= 6; }, 10.0));
  up.send(SIGKILL);
  EXPECT_TRUE(eventually([&] { return processes_with(services).empty(); }, 5.0));
}

TEST(Demo, RefusesAnUnknownScenarioAndNamesThoseThatExist) {
  Folder folder;
  Program demo({"demo", "--scenario", "nowhere", "--headless", "--out", folder.path.string()},
               folder.path / "out");
  EXPECT_EQ(demo.wait(20.0), 2);
  EXPECT_NE(demo.output().find("t_intersection"), std::string::npos) << demo.output();
}

}  // namespace
}  // namespace foretrack
