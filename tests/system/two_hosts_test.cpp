// SPDX-License-Identifier: Apache-2.0
// The safety gate on a host of its own, behind a network that loses packets or is cut: what is
// flown meanwhile, and afterwards.
#include "tests/system/two_hosts.hpp"

#include "services/launch/domain.hpp"

namespace foretrack {
namespace {

constexpr double kPartition_s = 10.0;
constexpr double kLeastGap_m = 0.5;  // from the vehicle's middle to the person's

class TwoHosts : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!network_.is_ready()) GTEST_SKIP() << "no network namespaces: not root, or no /dev/net/tun";
    start(kVehicle, {"simulator", "--scenario", "open_field", "--map", "known", "--endless",
                     "--people-wait", "60"});
    start(kVehicle, {"stages", "--no-mapping", "--use-sim-time"});
    start(kGate,
          {"safety_gate", "--use-sim-time", "--state-dir", (folder_.path / "gate").string()});
    ASSERT_TRUE(flies_on_order());
  }
  void start(int host, std::vector<std::string> words) {
    const auto out = folder_.path / words[0];
    programs_.push_back(run(host, std::move(words), out));
  }
  std::unique_ptr<Program> run(int host, std::vector<std::string> words,
                               const std::filesystem::path& out) const {
    words.insert(words.end(), {"--domain", std::to_string(domain_.id())});
    // The one by its address, the other whatever it has.
    words.insert(words.end(), {"--interface", host == kGate ? kAddressOfGate : "any"});
    return std::make_unique<Program>(network_.on(host, std::move(words)), out, "/usr/bin/env");
  }
  /// What is seen from there.
  Json look(int host) {
    const auto monitor = run(host, {"monitor", "--json", "--for", "1.5"}, folder_.path / "monitor");
    monitor->wait(20.0);
    return last_json(monitor->output());
  }
  std::string mode() { return mode_in(look(kGate)); }
  bool reaches(const std::string& wanted) {
    return eventually([&] { return mode() == wanted; }, 60.0);
  }
  bool order(const std::string& what) {
    return run(kGate, {"order", what}, folder_.path / "order")->wait(20.0) == 0;
  }
  bool flies_on_order() {
    return foretrack::flies_on_order([this] { return mode(); },
                                     [this](const std::string& what) { return order(what); });
  }

  const FreeDomain domain_;
  Folder folder_;
  TwoHostsNetwork network_{folder_.path};
  std::vector<std::unique_ptr<Program>> programs_;
};

TEST_F(TwoHosts, AVehicleFollowsAndObeysWhereAThirdOfAllPacketsIsLost) {
  network_.lose("0.3");
  int tracked = 0;
  EXPECT_TRUE(eventually(
      [&] {
        if (mode() != "track") return false;
        const double distance_m = look(kVehicle).value("distance_m", -1.0);
        if (distance_m < 0.0) return false;  // not heard yet
        EXPECT_GT(distance_m, kLeastGap_m);
        return ++tracked >= 5;
      },
      60.0))
      << tracked;
  EXPECT_TRUE(eventually([&] { return order("hold"); }, 60.0));
  EXPECT_TRUE(reaches("hover"));
  EXPECT_TRUE(flies_on_order());
}

TEST_F(TwoHosts, WithoutTheOptionNobodyElseIsHeardAndTheDoctorSaysWhatHelps) {
  Program doctor(network_.on(kGate, {"doctor", "--domain", std::to_string(domain_.id())}),
                 folder_.path / "doctor", "/usr/bin/env");
  EXPECT_EQ(doctor.wait(30.0), 1) << doctor.output();
  EXPECT_NE(doctor.output().find("Only this machine is heard"), std::string::npos)
      << doctor.output();
  EXPECT_NE(doctor.output().find("--interface"), std::string::npos) << doctor.output();
  // The vehicle's host flies; the gate's own process is all that is heard here.
  Program here(network_.on(kGate, {"monitor", "--json", "--for", "3", "--domain",
                                   std::to_string(domain_.id())}),
               folder_.path / "here", "/usr/bin/env");
  here.wait(30.0);
  const Json seen = last_json(here.output());
  EXPECT_EQ(mode_in(seen), "track") << "the gate stands on this host " << seen;
  EXPECT_LT(seen.value("distance_m", -1.0), 0.0) << "heard of the other host: " << seen;
}

TEST_F(TwoHosts, ACutNetworkStopsTheVehicleAndNothingIsResumedWhenItIsMended) {
  network_.lose("1");
  const auto cut = std::chrono::steady_clock::now();
  EXPECT_TRUE(eventually([&] { return look(kVehicle).value("speed_mps", 9.0) < 0.3; }, 60.0))
      << "the flight controller holds by itself";
  std::this_thread::sleep_until(cut + Seconds(kPartition_s));
  network_.lose("0");
  EXPECT_TRUE(reaches("silent")) << "it waits for an order";
  EXPECT_LT(look(kVehicle).value("speed_mps", 9.0), 0.3);
  EXPECT_EQ(mode(), "silent");
  EXPECT_TRUE(flies_on_order());
}

}  // namespace
}  // namespace foretrack
