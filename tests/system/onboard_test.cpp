// SPDX-License-Identifier: Apache-2.0
// The vehicle's own processes under their supervisor: idle until an order, started again when they
// end, and what is flown when one of them is paused.
#include "services/launch/domain.hpp"
#include "tests/system/program.hpp"

namespace foretrack {
namespace {

class OnboardProcesses : public ::testing::Test {
 protected:
  std::vector<std::string> on_domain(std::vector<std::string> words) const {
    words.insert(words.end(), {"--domain", std::to_string(domain_.id())});
    return words;
  }
  std::string mode() {
    Program program(on_domain({"monitor", "--json", "--for", "1.5"}), folder_.path / "monitor");
    program.wait(20.0);
    return mode_in(last_json(program.output()));
  }
  bool reaches(const std::string& wanted, double limit_s = 30.0) {
    return eventually([&] { return mode() == wanted; }, limit_s);
  }
  bool flies_on_order() {
    return foretrack::flies_on_order([this] { return mode(); },
                                     [this](const std::string& what) { return order(what); });
  }
  bool order(const std::string& what) {
    Program program(on_domain({"order", what}), folder_.path / "order");
    return program.wait(20.0) == 0;
  }
  pid_t process(const std::string& name) {
    const auto pids = processes_with({name, "--domain", std::to_string(domain_.id())});
    return pids.size() == 1 ? pids[0] : -1;
  }

  const FreeDomain domain_;
  Folder folder_;
  Program simulator_{on_domain({"simulator", "--scenario", "open_field", "--map", "known",
                                "--endless", "--people-wait", "60"}),
                     folder_.path / "simulator"};
  Program onboard_{on_domain({"onboard", "--no-mapping", "--no-record", "--use-sim-time",
                              "--state-dir", (folder_.path / "state").string()}),
                   folder_.path / "onboard"};
};

TEST_F(OnboardProcesses, FlyOnOrderAloneAndAreStartedAgainWhenTheyEnd) {
  ASSERT_TRUE(reaches("silent")) << onboard_.output();
  EXPECT_NE(mode(), "track") << "it flew without an order";
  ASSERT_TRUE(flies_on_order()) << onboard_.output();
  for (const std::string name : {"safety_gate", "stages"}) {
    const pid_t before = process(name);
    ASSERT_GT(before, 0) << name;
    kill(before, SIGKILL);
    EXPECT_TRUE(eventually(
        [&] {
          const pid_t now = process(name);
          return now > 0 && now != before;
        },
        5.0))
        << name;
    EXPECT_TRUE(eventually(
        [&] { return onboard_.output().find(name + " was killed by KILL") != std::string::npos; },
        5.0))
        << onboard_.output();
  }
  EXPECT_TRUE(flies_on_order()) << onboard_.output();
  const std::vector<pid_t> children = {process("safety_gate"), process("stages")};
  onboard_.send(SIGTERM);
  EXPECT_EQ(onboard_.wait(10.0), 0) << onboard_.output();
  for (const pid_t child : children) EXPECT_NE(kill(child, 0), 0) << "left behind";
}

TEST_F(OnboardProcesses, BoundsAreSetFromTheTerminalUnderALeaseThatIsGivenBack) {
  const auto file = folder_.path / "bounds.yaml";
  const auto set = [&](const std::string& yaml) {
    std::ofstream(file) << yaml;
    Program program(on_domain({"order", "bounds", "--file", file.string()}),
                    folder_.path / "order");
    const int code = program.wait(20.0);
    return std::pair(code, program.output());
  };
  EXPECT_EQ(set("fence_m: [[0, 0], [1, 1]]\n").first, 2);
  EXPECT_NE(set("fence_m: [[0, 0], [1, 1]]\n").second.find("is no fence"), std::string::npos);
  EXPECT_EQ(set("altitude_max_m: 0.3\n"), std::pair(0, std::string("bounds: accepted\n")));
  EXPECT_TRUE(eventually([&] { return order("start"); }, 60.0)) << "nobody holds the lease";
  EXPECT_TRUE(reaches("hover", 60.0)) << "it is above already, and does not follow";
  EXPECT_EQ(set("fence_m: []\n").first, 0) << "lifts them";
  EXPECT_TRUE(flies_on_order());
}

TEST_F(OnboardProcesses, APausedStageIsHoveredOutAndAPausedGateGivesTheVehicleUp) {
  ASSERT_TRUE(flies_on_order()) << onboard_.output();
  const pid_t stages = process("stages"), gate = process("safety_gate");
  kill(stages, SIGSTOP);
  EXPECT_TRUE(eventually([&] { return mode() != "track"; }, 10.0));
  kill(stages, SIGCONT);
  EXPECT_TRUE(flies_on_order()) << onboard_.output();
  kill(gate, SIGSTOP);
  EXPECT_TRUE(eventually([&] { return mode() == ""; }, 10.0)) << "nothing is heard of it";
  kill(gate, SIGCONT);
  EXPECT_TRUE(reaches("silent")) << "the flight controller holds; nobody asked for it again";
  EXPECT_TRUE(flies_on_order()) << onboard_.output();
}

}  // namespace
}  // namespace foretrack
