// SPDX-License-Identifier: Apache-2.0
// Who can be heard, who may order, and what is said of it.
#include "services/launch/domain.hpp"
#include "tests/system/station_program.hpp"

namespace foretrack {
namespace {

class Network : public ::testing::Test {
 protected:
  /// The folder of one of the tests' identities.
  std::string identity(const std::string& name) {
    const auto store = folder_.path / "keys";
    if (!std::filesystem::exists(store)) {
      Program keys({"python3", FORETRACK_SOURCE_DIR "/tests/support/keystore.py", store.string()},
                   folder_.path / "keys.out", "/usr/bin/env");
      EXPECT_EQ(keys.wait(60.0), 0) << keys.output();
    }
    return store / "enclaves" / name;
  }
  std::vector<std::string> on_domain(std::vector<std::string> words) const {
    words.insert(words.end(), {"--domain", std::to_string(domain_.id())});
    return words;
  }
  std::filesystem::path place(const std::string& name) const {
    std::filesystem::create_directories(folder_.path / name);
    return folder_.path / name;
  }

  const FreeDomain domain_;
  Folder folder_;
};

TEST_F(Network, AStationSaysWhomItHearsAndWarnsOfAnOpenNetwork) {
  Station inside(on_domain({"station"}), place("inside"));
  EXPECT_TRUE(eventually(
      [&] { return inside.program().output().find("only this machine") != std::string::npos; },
      5.0))
      << inside.program().output();
  EXPECT_EQ(inside.status()["warnings"], Json::array());
  Station outside(on_domain({"station", "--interface", "any"}), place("outside"));
  EXPECT_TRUE(eventually([&] { return outside.status()["warnings"].size() == 1; }, 5.0))
      << outside.status();
  EXPECT_NE(outside.status()["warnings"].dump().find("not secured"), std::string::npos);
  EXPECT_NE(outside.program().output().find("not secured"), std::string::npos);
}

TEST_F(Network, AnUnknownInterfaceIsNamedWithThoseThereAre) {
  Program monitor(on_domain({"monitor", "--interface", "wlan77"}), folder_.path / "monitor");
  EXPECT_EQ(monitor.wait(10.0), 2);
  EXPECT_NE(monitor.output().find("lo (127.0.0.1)"), std::string::npos) << monitor.output();
}

TEST_F(Network, ToolsOnTheVehicleHearItWhateverInterfaceItUses) {
  Program gate(on_domain({"safety_gate", "--interface", "any", "--state-dir",
                          (folder_.path / "state").string()}),
               folder_.path / "gate");
  EXPECT_TRUE(eventually(
      [&] {
        Program monitor(on_domain({"monitor", "--json", "--for", "2"}), folder_.path / "monitor");
        monitor.wait(20.0);
        return mode_in(last_json(monitor.output())) == "silent";
      },
      30.0));
}

TEST_F(Network, AWrongIdentityIsToldInOneLine) {
  for (const auto& [name, why] :
       {std::pair{"expired", "cert.pem is no longer valid"}, {"nobody", "there is no folder"}}) {
    Program gate(on_domain({"safety_gate", "--security", identity(name), "--state-dir",
                            (folder_.path / "state").string()}),
                 folder_.path / "gate");
    EXPECT_EQ(gate.wait(10.0), 2);
    const auto text = gate.output();
    EXPECT_NE(text.find(why), std::string::npos) << text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  }
}

TEST_F(Network, AStationThatMayNotOrderSaysSoAndReadsOn) {
  Program gate(on_domain({"safety_gate", "--security", identity("vehicle"), "--state-dir",
                          (folder_.path / "state").string()}),
               folder_.path / "gate");
  Station viewer(on_domain({"station", "--enable-control", "--security", identity("viewer")}),
                 place("viewer"));
  Station operators(on_domain({"station", "--enable-control", "--security", identity("operator")}),
                    place("operator"));
  // What a station says of the vehicle; null: it was not heard.
  const auto told = [](Station& station, const char* name) {
    const Json vehicle = station.vehicle();
    return vehicle.is_object() ? vehicle.value(name, Json()) : Json();
  };
  EXPECT_TRUE(eventually([&] { return told(viewer, "orders_refused").is_string(); }, 40.0))
      << viewer.program().output();
  const auto why = told(viewer, "orders_refused").dump();
  EXPECT_NE(why.find("may not order uav1"), std::string::npos) << why;
  const Json stop = {{"vehicle", "uav1"}, {"command", "stop"}, {"operator", "ada"}};
  const Json refused = viewer.post("/api/command", stop);
  EXPECT_EQ(refused.value("ok", true), false) << refused;
  EXPECT_NE(refused.value("reason", "").find("may not order"), std::string::npos) << refused;
  EXPECT_TRUE(eventually(
      [&] {
        const Json seen_s_ago = told(viewer, "seen_s_ago");
        return seen_s_ago.is_number() && seen_s_ago.get<double>() < 1.0;
      },
      10.0))
      << "it reads on";
  EXPECT_TRUE(viewer.program().running());
  EXPECT_EQ(viewer.status()["warnings"], Json::array());

  EXPECT_TRUE(eventually([&] { return operators.vehicle().is_object(); }, 40.0));
  EXPECT_TRUE(
      eventually([&] { return operators.post("/api/command", stop).value("ok", false); }, 20.0))
      << operators.program().output() << gate.output();
  EXPECT_TRUE(told(operators, "orders_refused").is_null());
}

}  // namespace
}  // namespace foretrack
