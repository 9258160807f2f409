// SPDX-License-Identifier: Apache-2.0
// How the parts of a vehicle find each other on a network that carries no multicast.
#include "services/launch/domain.hpp"
#include "tests/system/two_hosts.hpp"

namespace foretrack {
namespace {

class Meeting : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!network_.is_ready()) GTEST_SKIP() << "no network namespaces: not root, or no /dev/net/tun";
  }
  /// The program on a host, with variables (NAME=VALUE) in front of its words.
  std::unique_ptr<Program> run(int host, const std::string& variable,
                               std::vector<std::string> words) {
    const auto out = folder_.path / (words[0] + std::to_string(runs_++));
    if (words[0] != "discovery-server")
      words.insert(words.end(), {"--domain", std::to_string(domain_.id())});
    auto all = network_.on(host, std::move(words));
    all.insert(all.begin(), variable);
    return std::make_unique<Program>(all, out, "/usr/bin/env");
  }
  std::unique_ptr<Program> gate(const std::string& variable, std::vector<std::string> words) {
    words.insert(words.begin(), {"safety_gate", "--state-dir", (folder_.path / "gate").string()});
    return run(kGate, variable, std::move(words));
  }
  /// Whether the gate is heard on the vehicle's host.
  bool heard(const std::string& variable, const std::vector<std::string>& words,
             double for_s = 20.0) {
    return eventually(
        [&] {
          std::vector<std::string> all = {"monitor", "--json", "--for", "2"};
          all.insert(all.end(), words.begin(), words.end());
          const auto monitor = run(kVehicle, variable, all);
          monitor->wait(20.0);
          return mode_in(last_json(monitor->output())) == "silent";
        },
        for_s);
  }

  const FreeDomain domain_;
  Folder folder_;
  TwoHostsNetwork network_{folder_.path, {"--no-multicast"}};
  int runs_ = 0;
};

constexpr char kNothing[] = "NOTHING=1";

TEST_F(Meeting, WithoutMulticastNobodyMeetsAndAPeerThatIsNamedIsMet) {
  const auto other = gate(kNothing, {"--interface", "any"});
  EXPECT_FALSE(heard(kNothing, {"--interface", "any"}, 3.0)) << "multicast passes";
  EXPECT_TRUE(heard(kNothing, {"--peer", kAddressOfGate})) << other->output();
  EXPECT_TRUE(heard(std::string("ROS_STATIC_PEERS=198.18.78.77;") + kAddressOfGate, {}));
  EXPECT_FALSE(heard("ROS_AUTOMATIC_DISCOVERY_RANGE=OFF", {"--peer", kAddressOfGate}, 1.0));
}

TEST_F(Meeting, AllMeetAtADiscoveryServer) {
  const auto at = std::string(kAddressOfGate) + ":11811";
  const auto server = run(kGate, kNothing, {"discovery-server", "--interface", "any"});
  const auto other = gate("ROS_DISCOVERY_SERVER=" + at, {});
  EXPECT_TRUE(heard(kNothing, {"--discovery-server", at})) << other->output() << server->output();
}

TEST_F(Meeting, WhatIsNoMeetingPointIsRefusedInOneLine) {
  for (const auto& [words, expected] :
       {std::pair{std::vector<std::string>{"--peer", "198.18.78.2:0"}, "HOST or HOST:PORT"},
        {{"--peer", "no.such.host.invalid"}, "is no IPv4 address, and no name"},
        {{"--discovery-server", kAddressOfGate, "--security", "/nowhere"}, "--peer HOST can"}}) {
    std::vector<std::string> all = {"monitor"};
    all.insert(all.end(), words.begin(), words.end());
    const auto monitor = run(kVehicle, kNothing, all);
    EXPECT_EQ(monitor->wait(20.0), 2) << monitor->output();
    const auto text = monitor->output();
    EXPECT_NE(text.find(expected), std::string::npos) << text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  }
}

}  // namespace
}  // namespace foretrack
