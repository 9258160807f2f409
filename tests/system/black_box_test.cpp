// SPDX-License-Identifier: Apache-2.0
// What the vehicle records of its flights by itself.
#include <algorithm>

#include "services/ground_station/mcap/reader.hpp"
#include "services/launch/domain.hpp"
#include "tests/system/program.hpp"

namespace foretrack {
namespace {

std::set<std::string> topics_in(const std::filesystem::path& folder) {
  std::set<std::string> topics;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".mcap") continue;
    station::mcap::Reader reader(entry.path());
    while (const auto message = reader.next())
      topics.insert(reader.channels().at(message->channel).topic);
  }
  return topics;
}

TEST(BlackBox, RecordsWhatTheServicesSayAndNoPictures) {
  const FreeDomain domain;
  const std::string id = std::to_string(domain.id());
  Folder folder;
  Program simulator(
      {"simulator", "--domain", id, "--map", "depth", "--endless", "--scenario", "open_field"},
      folder.path / "simulator");
  Program onboard(
      {"onboard", "--domain", id, "--use-sim-time", "--state-dir", folder.path.string()},
      folder.path / "onboard");
  const auto recordings = folder.path / "recordings" / "uav1";
  const std::set<std::string> said = {"/rosout", "/uav1/health", "/uav1/odometry",
                                      "/uav1/safety/state"};
  const auto records = [&] {
    if (!std::filesystem::exists(recordings)) return false;
    try {
      const auto topics = topics_in(recordings);
      return std::includes(topics.begin(), topics.end(), said.begin(), said.end());
    } catch (const std::exception&) {  // it is being written
      return false;
    }
  };
  EXPECT_TRUE(eventually(records, 30.0)) << onboard.output();
  simulator.send(SIGTERM);
  onboard.send(SIGTERM);
  EXPECT_EQ(onboard.wait(10.0), 0) << onboard.output();
  const auto topics = topics_in(recordings);
  EXPECT_FALSE(topics.contains("/uav1/camera/depth/image"));
}

TEST(BlackBox, ThatCannotRecordDoesNotEndTheVehiclesServices) {
  const FreeDomain domain;
  const std::string id = std::to_string(domain.id());
  Folder folder;
  Program onboard({"onboard", "--domain", id, "--state-dir", folder.path.string(), "--record-dir",
                   "/proc/no/such/folder"},
                  folder.path / "onboard");
  EXPECT_TRUE(
      eventually([&] { return onboard.output().find("black_box") != std::string::npos; }, 20.0))
      << onboard.output();
  EXPECT_EQ(processes_with({"safety_gate", "--domain", id}).size(), 1u) << onboard.output();
  onboard.send(SIGTERM);
  EXPECT_EQ(onboard.wait(10.0), 0) << onboard.output();
}

}  // namespace
}  // namespace foretrack
