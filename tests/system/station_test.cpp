// SPDX-License-Identifier: Apache-2.0
// The ground station beside a flight: what it passes on, records, replays and commands.
#include <future>
#include <map>
#include <memory>

#include "services/launch/domain.hpp"
#include "tests/system/station_program.hpp"

namespace foretrack {
namespace {

/// A flight and a station beside it.
struct Flown {
  FreeDomain domain;
  std::string id = std::to_string(domain.id());
  Folder folder;
  Program flight{{"up", "--scenario", "t_intersection", "--domain", id, "--out",
                  (folder.path / "up").string()},
                 folder.path / "up.out"};
  Station station{{"station", "--domain", id, "--enable-control", "--recordings",
                   (folder.path / "recordings").string()},
                  folder.path};
};

/// One flight for all.
class StationOnAFlight : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { flown_ = std::make_unique<Flown>(); }
  static void TearDownTestSuite() { flown_.reset(); }
  std::string domain() const { return flown_->id; }
  Json monitor() {
    Program program({"monitor", "--json", "--for", "1.5", "--domain", domain()},
                    folder_.path / "monitor.out");
    program.wait(20.0);
    std::istringstream lines(program.output());
    Json last = Json::object();
    for (std::string line; std::getline(lines, line);)
      if (auto json = Json::parse(line, nullptr, false); json.is_object()) last = std::move(json);
    return last;
  }

  bool obeys_an_order() {
    const auto safety = monitor().value("safety", Json());
    return safety.is_object() && safety.value("reason", "") == "an operator's order";
  }

  static inline std::unique_ptr<Flown> flown_;
  const Folder& folder_ = flown_->folder;
  Station& station_ = flown_->station;
};

double number(const Json& json, const char* pointer) {
  const auto& value = json[Json::json_pointer(pointer)];
  return value.is_number() ? value.get<double>() : std::nan("");
}

TEST_F(StationOnAFlight, OfficialClientsDecodeEveryTopicUnderBothSubprotocols) {
  if (!has_npm_packages()) GTEST_SKIP() << "npm ci was not run in " << kWeb;
  ASSERT_TRUE(eventually([&] { return monitor().value("distance_m", -1.0) > 0.0; }, 60.0));
  const auto probed = [this](const std::string& protocol) {
    return std::async(std::launch::async, [=, this] {
      return probe("probe.mjs", {station_.websocket(), "4", protocol});
    });
  };
  std::map<std::string, std::future<Json>> reports;
  for (const std::string protocol : {"foxglove.websocket.v1", "foxglove.sdk.v1"})
    reports[protocol] = probed(protocol);
  for (auto& [protocol, coming] : reports) {
    const Json report = coming.get();
    EXPECT_EQ(report["protocol"], protocol);
    EXPECT_TRUE(report["errors"].empty() && report["status"].empty()) << report["errors"];
    const auto& topics = report["topics"];
    for (const auto* name :
         {"/station/status", "/clock", "/tf", "/tf_static", "/diagnostics", "/uav1/odometry",
          "/uav1/camera/depth/image", "/uav1/map/points", "/uav1/markers", "/uav1/plan/path",
          "/uav1/plan/trajectory", "/uav1/safety/state", "/uav1/target/state",
          "/uav1/target/intention", "/uav1/target/prediction", "/fmu/out/vehicle_status_v1"}) {
      ASSERT_TRUE(topics.contains(name)) << name;
      EXPECT_GT(topics[name]["samples"], 0) << name;
    }
    for (const auto& [name, topic] : topics.items())
      EXPECT_FALSE(topic.contains("error")) << name << topic["error"];
    const auto& odometry = topics["/uav1/odometry"]["last"];
    const auto& truth = topics["/uav1/simulator/vehicle"]["last"];
    for (const auto* axis : {"/pose/pose/position/x", "/pose/pose/position/y"})
      EXPECT_NEAR(number(odometry, axis), number(truth, axis), 0.5);
    EXPECT_EQ(report["publishers"]["/uav1/plan/trajectory"], Json({"uav1/planning"}));
    const auto& hear = report["subscribers"]["/uav1/plan/trajectory"];
    EXPECT_NE(std::find(hear.begin(), hear.end(), "uav1/safety_gate"), hear.end()) << hear;
    double sum = 0.0;
    for (const auto& intention : topics["/uav1/target/intention"]["last"]["intentions"])
      sum += intention["probability"].get<double>();
    EXPECT_NEAR(sum, 1.0, 1e-6);
    const auto& rotation = topics["/tf"]["last"]["transforms"][0]["transform"]["rotation"];
    EXPECT_NEAR(std::hypot(rotation["x"].get<double>(), rotation["y"].get<double>(),
                           std::hypot(rotation["z"].get<double>(), rotation["w"].get<double>())),
                1.0, 1e-9);
    const auto& image = topics["/uav1/camera/depth/image"]["last"];
    EXPECT_EQ(image["data"],
              std::to_string(image["step"].get<int>() * image["height"].get<int>()) + " items");
  }
}

TEST_F(StationOnAFlight, OneOperatorHoldsTheLeaseAndStopAlwaysWins) {
  ASSERT_TRUE(eventually([&] { return !station_.vehicle().is_null(); }, 60.0));
  const auto lease = [&](const char* name, const char* action, const char* to = "") {
    return station_.post("/api/lease",
                         {{"vehicle", "uav1"}, {"operator", name}, {"action", action}, {"to", to}});
  };
  const auto command = [&](const char* name, const char* what) {
    return station_.post("/api/command",
                         {{"vehicle", "uav1"}, {"operator", name}, {"command", what}});
  };
  EXPECT_EQ(station_.post("/api/command", {{"vehicle", "uav1"}}, std::string(64, '0'))["reason"],
            "a valid token expected");
  ASSERT_TRUE(eventually([&] { return lease("ada", "take")["ok"] == true; }, 20.0));
  EXPECT_EQ(lease("bob", "take")["reason"], "ada holds the lease");
  EXPECT_EQ(command("bob", "hold")["reason"], "ada holds the lease");
  EXPECT_TRUE(eventually([&] { return station_.vehicle()["lease"]["operator"] == "ada"; }, 5.0));

  EXPECT_EQ(command("ada", "resume")["reason"], "refused: not in this phase");
  EXPECT_EQ(command("ada", "hold")["ok"], true);
  EXPECT_TRUE(eventually([&] { return obeys_an_order(); }, 10.0));
  EXPECT_EQ(station_.vehicle()["last_command"]["command"], "hold");

  EXPECT_EQ(lease("ada", "hand_over", "bob")["ok"], true);
  EXPECT_EQ(command("ada", "resume")["reason"], "bob holds the lease");
  EXPECT_EQ(command("bob", "resume")["ok"], true);

  EXPECT_EQ(command("carol", "stop")["ok"], true);
  EXPECT_TRUE(eventually([&] { return obeys_an_order(); }, 10.0));
  EXPECT_TRUE(eventually([&] { return monitor().value("speed_mps", 9.0) < 0.3; }, 3.0));
  EXPECT_EQ(station_.vehicle()["last_command"]["operator"], "carol");
  EXPECT_EQ(lease("bob", "release")["ok"], true);

  const auto audit = text_of(folder_.path / "audit");
  for (const auto* fact : {"\"hand_over\"", "\"stop\"", "\"carol\"", "a valid token expected"})
    EXPECT_NE(audit.find(fact), std::string::npos) << fact;
}

TEST_F(StationOnAFlight, WhatItRecordsReadsBackWithTheOfficialLibrary) {
  if (!has_npm_packages()) GTEST_SKIP() << "npm ci was not run in " << kWeb;
  ASSERT_TRUE(eventually([&] { return monitor().value("distance_m", -1.0) > 0.0; }, 60.0));
  ASSERT_EQ(station_.post("/api/record", {{"action", "start"}})["ok"], true);
  ASSERT_TRUE(
      eventually([&] { return station_.status()["recording"].value("seconds", 0.0) > 6.0; }, 20.0));
  ASSERT_EQ(station_.post("/api/record", {{"action", "stop"}})["ok"], true);
  ASSERT_TRUE(eventually([&] { return station_.status()["recording"].is_null(); }, 10.0));
  const auto list = Json::parse(station_.get("/api/recordings"));
  ASSERT_EQ(list.size(), 1u);
  const auto file = folder_.path / "recordings" / list[0]["file"].get<std::string>();

  auto reading = std::async(std::launch::async, [&] { return probe("mcap.mjs", {file.string()}); });
  Folder folder;
  const FreeDomain elsewhere;
  const auto id = std::to_string(elsewhere.id());
  Program writer({"replay", file.string(), "--onto-dds", "--domain", id}, folder.path / "replay");
  Program topics({"topics", "--json", "--for", "5", "--domain", id}, folder.path / "topics");
  ASSERT_EQ(topics.wait(20.0), 0);
  std::map<std::string, int> samples;
  for (const auto& topic : Json::parse(topics.output())) samples[topic["wire"]] = topic["samples"];
  EXPECT_GT(samples["rt/uav1/odometry"], 50);
  EXPECT_GT(samples["rt/uav1/target/state"], 20);
  EXPECT_EQ(samples["rt/fmu/in/trajectory_setpoint"], 0) << "a replay must not move a vehicle";

  const Json report = reading.get();
  ASSERT_FALSE(report["indexed"].contains("error")) << report["indexed"];
  EXPECT_EQ(report["indexed"]["messages"], report["indexed"]["counted"]);
  EXPECT_EQ(report["indexed"]["messages"], report["streamed"]["messages"]) << report["streamed"];
  EXPECT_TRUE(report["indexed"]["ordered"] && report["streamed"]["done"]);
  EXPECT_TRUE(report["metadata"]["foretrack"].contains("version"));
  EXPECT_TRUE(report["metadata"]["parameters"].contains("yaml"));
  EXPECT_EQ(report["topics"]["/uav1/odometry"]["schemaEncoding"], "ros2msg");
  EXPECT_EQ(report["topics"]["/uav1/target/state"]["schemaEncoding"], "ros2msg");
  EXPECT_EQ(report["topics"]["/tf_static"]["samples"], 1);
  EXPECT_GT(report["topics"]["/uav1/odometry"]["samples"], 200);

  Station replay({"replay", file.string(), "--speed", "4", "--again"}, folder.path);
  const Json played = probe("probe.mjs", {replay.websocket(), "3"});
  EXPECT_GT(played["topics"]["/uav1/odometry"]["samples"], 100);
  EXPECT_TRUE(played["topics"]["/uav1/odometry"]["last"].contains("pose"));
}

TEST_F(StationOnAFlight, ARecorderThatIsKilledLeavesAReadableFile) {
  if (!has_npm_packages()) GTEST_SKIP() << "npm ci was not run in " << kWeb;
  const auto recordings = folder_.path / "killed";
  const std::vector<std::string> record = {"record", "--domain", domain(), "--recordings",
                                           recordings.string()};
  std::filesystem::path file;
  {
    Program recorder(record, folder_.path / "record.out");
    ASSERT_TRUE(eventually(
        [&] {
          std::error_code error;
          for (const auto& entry : std::filesystem::directory_iterator(recordings, error))
            file = entry.path();
          return !file.empty() && std::filesystem::file_size(file) > 500'000;
        },
        60.0));
    recorder.send(SIGKILL);
    recorder.wait(5.0);
  }
  const Json torn = probe("mcap.mjs", {file.string()});
  EXPECT_TRUE(torn["indexed"].contains("error"));
  ASSERT_TRUE(torn["streamed"].contains("messages")) << torn["streamed"];
  EXPECT_GT(torn["streamed"]["messages"], 100);
  auto again = record;
  again.insert(again.end(), {"--for", "1"});
  Program recorder(again, folder_.path / "record.out");
  ASSERT_EQ(recorder.wait(30.0), 0) << recorder.output();
  const Json whole = probe("mcap.mjs", {file.string()});
  EXPECT_EQ(whole["indexed"]["messages"], torn["streamed"]["messages"]) << whole["indexed"];
}

}  // namespace
}  // namespace foretrack
