// SPDX-License-Identifier: Apache-2.0
// What a user is told when something is missing.
#include "services/launch/domain.hpp"
#include "tests/system/program.hpp"

namespace foretrack {
namespace {

struct Bus {
  FreeDomain domain;
  std::string id = std::to_string(domain.id());
  Folder folder;

  std::vector<std::string> on_bus(std::vector<std::string> words) const {
    words.insert(words.end(), {"--domain", id});
    return words;
  }
  Json doctor() {
    Program doctor(on_bus({"doctor", "--json"}), folder.path / "doctor");
    exit_code = doctor.wait(30.0);
    return Json::parse(doctor.output());
  }
  int exit_code = -1;
};

TEST(Doctor, SaysThatNobodyIsThereOnAnEmptyDomain) {
  Bus bus;
  const auto said = bus.doctor();
  EXPECT_EQ(bus.exit_code, 1);
  EXPECT_NE(said["first_cause"].get<std::string>().find("No process of vehicle 'uav1'"),
            std::string::npos)
      << said.dump(1);
}

TEST(Doctor, NamesTheSilentTopicAndItsService) {
  Bus bus;
  Program simulator(
      bus.on_bus({"simulator", "--scenario", "t_intersection", "--map", "depth", "--endless"}),
      bus.folder.path / "simulator");
  Program perception(bus.on_bus({"perception", "--use-sim-time"}), bus.folder.path / "perception");
  std::string cause;
  // The person must be seen before the map is the first thing that is missing.
  ASSERT_TRUE(eventually(
      [&] {
        const auto said = bus.doctor();
        cause = said["first_cause"].is_string() ? said["first_cause"].get<std::string>() : "";
        return cause.find("map/local") != std::string::npos;
      },
      30.0))
      << cause;
  EXPECT_EQ(bus.exit_code, 1);
  EXPECT_NE(cause.find("the service mapping is missing"), std::string::npos) << cause;
}

TEST(Doctor, NamesTheOtherVehiclesOnTheDomain) {
  Bus bus;
  Program perception(bus.on_bus({"perception", "--vehicle", "kestrel"}),
                     bus.folder.path / "perception");
  std::string advice;
  EXPECT_TRUE(eventually(
      [&] {
        const auto findings = bus.doctor()["findings"];
        advice = findings.back()["advice"];
        return advice.find("kestrel") != std::string::npos;
      },
      20.0))
      << advice;
}

TEST(Topics, ListsWritersReadersAndRates) {
  Bus bus;
  Program simulator(bus.on_bus({"simulator", "--endless"}), bus.folder.path / "simulator");
  Program perception(bus.on_bus({"perception", "--use-sim-time"}), bus.folder.path / "perception");
  Json observation;
  EXPECT_TRUE(eventually(
      [&] {
        Program topics(bus.on_bus({"topics", "--json", "--for", "2"}), bus.folder.path / "topics");
        if (topics.wait(20.0) != 0) return false;
        for (const auto& topic : Json::parse(topics.output()))
          if (topic["topic"] == "target/observation") observation = topic;
        return observation["writers"] == 1 && observation["readers"] == 1 &&
               observation["rate_hz"] > 5.0;
      },
      30.0))
      << observation.dump(1);
}

TEST(Monitor, PrintsPlainLinesWithoutATerminal) {
  Bus bus;
  Program monitor(bus.on_bus({"monitor", "--for", "2"}), bus.folder.path / "monitor");
  EXPECT_EQ(monitor.wait(20.0), 0);
  EXPECT_NE(monitor.output().find("person ?"), std::string::npos) << monitor.output();
  EXPECT_EQ(monitor.output().find('\033'), std::string::npos);
}

}  // namespace
}  // namespace foretrack
