// SPDX-License-Identifier: Apache-2.0
// After a pause in which only one of two sides forgot the other, all is heard again.
#include <cstdlib>
#include <map>
#include <memory>

#include "services/common/node.hpp"
#include "services/common/raw.hpp"
#include "services/launch/domain.hpp"
#include "tests/system/station_program.hpp"

namespace foretrack {
namespace {

constexpr double kShortLease_s = 2.0;
constexpr double kPause_s = 2.0 * kShortLease_s;

/// A folder of shipped files in which participants announce a short lease.
void write_short_lease(const std::filesystem::path& share) {
  auto profiles = text_of(FORETRACK_SOURCE_DIR "/qos/profiles.xml");
  const std::string lease = "<leaseDuration>\n              <sec>20</sec>";
  const auto at = profiles.find(lease);
  ASSERT_NE(at, std::string::npos);
  profiles.replace(at, lease.size(), "<leaseDuration><sec>2</sec>");
  std::filesystem::create_directories(share / "qos");
  std::ofstream(share / "qos/profiles.xml") << profiles;
}

// The more often two sides acknowledged each other's endpoints, the longer one that forgot is not
// understood: with twelve, for minutes.
constexpr int kTopics = 12;
constexpr char kDomain[] = "FORETRACK_TEST_DOMAIN";

/// Run by the tests below as a process of its own: a vehicle whose topics come up one by one.
TEST(RejoinPart, DISABLED_Vehicle) {
  const char* domain = std::getenv(kDomain);
  ASSERT_TRUE(domain);
  NodeOptions options;
  options.service = "growing";
  options.domain_id = std::stoi(domain);
  Node node(options);
  std::vector<std::unique_ptr<RawWriter>> writers;
  for (int step = 0;; ++step) {
    if (step % 6 == 0 && writers.size() < kTopics)
      writers.push_back(std::make_unique<RawWriter>(
          node,
          RawTopic{"rt/uav1/grown" + std::to_string(writers.size()), "some::msg::dds_::T_", false},
          "state"));
    for (const auto& writer : writers) writer->write({0, 1, 0, 0, 1, 2, 3, 4});
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
}

class Rejoin : public ::testing::Test {
 protected:
  void SetUp() override { write_short_lease(share()); }
  std::filesystem::path share() const { return folder_.path / "share"; }
  std::vector<std::string> on_domain(std::vector<std::string> words) const {
    words.insert(words.end(), {"--domain", std::to_string(domain_.id())});
    return words;
  }
  /// Of its own process, to be run by env.
  std::vector<std::string> growing_vehicle(const std::filesystem::path& share) const {
    return {"FORETRACK_SHARE=" + share.string(), kDomain + ("=" + std::to_string(domain_.id())),
            std::filesystem::read_symlink("/proc/self/exe"), "--gtest_also_run_disabled_tests",
            "--gtest_filter=RejoinPart.*"};
  }
  static bool has_grown(Station& station) {
    return live(station).contains("/uav1/grown" + std::to_string(kTopics - 1));
  }
  /// Channels of the vehicle's topics that come at 1 Hz or more, and came just now.
  static std::map<std::string, int> live(Station& station) {
    std::map<std::string, int> result;
    const auto status = station.status();
    for (const auto& t : status["topics"])
      if (t["topic"].get<std::string>().starts_with("/uav1/") && t["age_s"].is_number() &&
          t["age_s"] < 1.9 && t["rate_hz"] > 0.7)
        result[t["topic"]] = t["channel"];
    return result;
  }
  static std::string missing(Station& station, const std::map<std::string, int>& wanted) {
    std::string result;
    const auto now = live(station);
    for (const auto& [topic, channel] : wanted) {
      const auto it = now.find(topic);
      if (it == now.end() || it->second != channel) result += topic + ' ';
    }
    return result;
  }
  static void pause(Program& program) {
    program.send(SIGSTOP);
    std::this_thread::sleep_for(Seconds(kPause_s));  // leases run by the clock
    program.send(SIGCONT);
    std::this_thread::sleep_for(Seconds(2.5));  // what was in the sockets is no sign of life
  }
  static int rejoins(Station& station) {
    const auto text = station.program().output();
    int count = 0;
    for (auto at = text.find("anew"); at != std::string::npos; at = text.find("anew", at + 1))
      ++count;
    return count;
  }

  const FreeDomain domain_;
  Folder folder_;
};

TEST_F(Rejoin, AStationThatVehiclesForgotHearsAndOrdersAgain) {
  Program world(on_domain({"simulator", "--scenario", "t_intersection", "--map", "known",
                           "--endless", "--people-wait", "60"}),
                folder_.path / "simulator");
  Program onboard(on_domain({"onboard", "--no-mapping", "--no-record", "--use-sim-time",
                             "--state-dir", (folder_.path / "state").string()}),
                  folder_.path / "onboard");
  Station station(on_domain({"station", "--enable-control", "--recordings",
                             (folder_.path / "recordings").string()}),
                  folder_.path, 0, share());
  const auto ask = [&](const char* path, const char* key, const char* what) {
    return station.post(path, {{"vehicle", "uav1"}, {"operator", "ada"}, {key, what}})["ok"] ==
           true;
  };
  ASSERT_TRUE(eventually([&] { return live(station).contains("/uav1/plan/trajectory"); }, 60.0));
  ASSERT_TRUE(eventually([&] { return ask("/api/lease", "action", "take"); }, 20.0));
  ASSERT_TRUE(ask("/api/command", "command", "start"));  // before the person is out of sight
  Program growing(growing_vehicle({}), folder_.path / "growing", "/usr/bin/env");
  ASSERT_TRUE(eventually([&] { return has_grown(station); }, 30.0));
  ASSERT_TRUE(ask("/api/record", "action", "start"));
  const auto before = live(station);
  ASSERT_GT(before.size(), kTopics + 8u);
  pause(station.program());
  EXPECT_TRUE(eventually([&] { return missing(station, before).empty(); }, 20.0))
      << missing(station, before) << station.program().output();
  EXPECT_EQ(rejoins(station), 1) << station.program().output();
  EXPECT_TRUE(eventually([&] { return ask("/api/command", "command", "hold"); }, 20.0));
  EXPECT_TRUE(eventually([&] { return station.vehicle()["lease"]["operator"] == "ada"; }, 10.0));
  EXPECT_EQ(station.status()["recording"]["active"], true);
}

TEST_F(Rejoin, AVehicleThatPausesIsHeardAgainAndOneThatEndsIsNoReasonToJoinAnew) {
  Station station(on_domain({"station"}), folder_.path);
  Program growing(growing_vehicle(share()), folder_.path / "growing", "/usr/bin/env");
  ASSERT_TRUE(eventually([&] { return has_grown(station); }, 60.0));
  const auto before = live(station);
  ASSERT_EQ(before.size(), std::size_t{kTopics});
  pause(growing);
  EXPECT_TRUE(eventually([&] { return missing(station, before).empty(); }, 20.0))
      << missing(station, before) << station.program().output();
  const int before_its_end = rejoins(station);
  EXPECT_LE(before_its_end, 1) << "it depends on who forgot whom";
  growing.send(SIGKILL);
  const auto ended = [&] {
    const auto status = station.status();
    for (const auto& t : status["topics"])
      if (t["writers"] != 0 || t["channel"] != 0) return false;
    return true;
  };
  EXPECT_TRUE(eventually(ended, 30.0)) << "10 s after its writers its channels close";
  EXPECT_EQ(rejoins(station), before_its_end) << station.program().output();
}

}  // namespace
}  // namespace foretrack
