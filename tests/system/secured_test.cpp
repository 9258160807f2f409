// SPDX-License-Identifier: Apache-2.0
// A flight whose every process has an identity, from a new keystore to an order.
#include "services/launch/domain.hpp"
#include "tests/system/program.hpp"

namespace foretrack {
namespace {

class Secured : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto store = (folder_.path / "keys").string();
    ASSERT_EQ(say({"security", "init", store, "--simulation"}).exit_code, 0);
    ASSERT_EQ(say({"security", "issue", store, "--vehicle", "uav1"}).exit_code, 0);
  }
  struct Said {
    int exit_code = -1;
    std::string text;
  };
  Said say(const std::vector<std::string>& words) {
    Program program(words, folder_.path / "said");
    const int exit_code = program.wait(30.0);
    return {exit_code, program.output()};
  }
  std::vector<std::string> on_domain(std::vector<std::string> words,
                                     const std::string& identity) const {
    words.insert(words.end(), {"--domain", std::to_string(domain_.id())});
    if (!identity.empty()) words.insert(words.end(), {"--security", identity});
    return words;
  }
  std::string identities(const char* role = "") const {
    return folder_.path / "keys/enclaves/uav1" / role;
  }
  std::string mode() {
    return mode_in(
        last_json(say(on_domain({"monitor", "--json", "--for", "4"}, identities())).text));
  }
  bool reaches(const std::string& wanted, double limit_s = 60.0) {
    return eventually([&] { return mode() == wanted; }, limit_s);
  }

  const FreeDomain domain_;
  Folder folder_;
};

TEST_F(Secured, AVehicleFliesObeysItsOperatorAndNobodyElse) {
  Program up(on_domain({"up", "--scenario", "open_field", "--map", "known", "--out",
                        (folder_.path / "up").string()},
                       identities()),
             folder_.path / "up.out");
  ASSERT_TRUE(reaches("track")) << up.output();

  const auto viewer = say(on_domain({"order", "hold", "--for", "3"}, identities("viewer")));
  EXPECT_EQ(viewer.exit_code, 1);
  EXPECT_NE(viewer.text.find("DDS refuses to write rt/uav1/mission/command"), std::string::npos)
      << viewer.text;
  const auto nobody = say(on_domain({"order", "stop", "--for", "3"}, ""));
  EXPECT_EQ(nobody.exit_code, 1);
  EXPECT_NE(nobody.text.find("nothing was heard of the safety gate"), std::string::npos)
      << nobody.text;
  EXPECT_EQ(mode(), "track") << "it obeyed somebody who may not order";
  const auto doctor = say(on_domain({"doctor"}, identities())).text;
  EXPECT_NE(doctor.find("a participant without an identity"), std::string::npos) << doctor;

  EXPECT_TRUE(eventually(
      [&] {
        return say(on_domain({"order", "hold"}, identities())).exit_code == 0;
      },
      30.0));
  EXPECT_TRUE(reaches("hover"));
}

TEST_F(Secured, TheCommandsSayWhatIsWrong) {
  EXPECT_EQ(say({"security", "check", identities()}).exit_code, 0);
  EXPECT_EQ(say({"security", "revoke", folder_.path / "keys", "operator"}).exit_code, 0);
  const auto check = say({"security", "check", folder_.path / "keys"});
  EXPECT_EQ(check.exit_code, 1);
  EXPECT_NE(check.text.find("BAD  /uav1/operator"), std::string::npos) << check.text;
  EXPECT_NE(check.text.find("was revoked"), std::string::npos) << check.text;
  const auto order = say(on_domain({"order", "stop"}, identities()));
  EXPECT_EQ(order.exit_code, 2);
  EXPECT_EQ(std::ranges::count(order.text, '\n'), 1) << order.text;
  EXPECT_EQ(
      say({"security", "issue", folder_.path / "keys", "--vehicle", "uav1", "cook"}).exit_code, 2);
  EXPECT_EQ(say({"security", "issue", folder_.path / "keys"}).exit_code, 2);
}

TEST(VehicleFile, IsCheckedWithItsIdentitiesAndItsKeysAreOptions) {
  Folder folder;
  const auto file = folder.path / "uav7.yaml";
  const auto check = [&](const std::string& text) {
    std::ofstream(file) << text;
    Program program({"check", file.string()}, folder.path / "said");
    return std::pair{program.wait(20.0), program.output()};
  };
  const auto [good, said] =
      check("vehicle: uav7\ndomain: 7\npx4_odometry: true\npeer: [127.0.0.1]\n");
  EXPECT_EQ(good, 0) << said;
  EXPECT_NE(said.find("uav7, DDS domain 7"), std::string::npos) << said;
  const auto [bad, why] = check("vehicle: uav7\ndomain: 777\ndomian: 7\nsecurity: [a, b]\n");
  EXPECT_EQ(bad, 2) << why;
  EXPECT_NE(why.find("uav7.yaml:2"), std::string::npos) << why;
  EXPECT_NE(why.find("'domian' is none of vehicle, px4_namespace"), std::string::npos) << why;
  const auto [other, name] = check("vehicle: uav8\nsecurity: /nowhere\n");
  EXPECT_EQ(other, 1);
  EXPECT_NE(name.find("is 'uav8', and the file's name says uav7"), std::string::npos) << name;
  EXPECT_NE(name.find("there is no folder /nowhere"), std::string::npos) << name;
}

TEST(VehicleFile, IsTakenByTheServicesAndTheCommandLineGoesFirst) {
  Folder folder;
  const auto file = folder.path / "uav7.yaml";
  std::ofstream(file) << "interface: wlan77\n";
  Program refused({"safety_gate", "--config", file.string()}, folder.path / "refused");
  EXPECT_EQ(refused.wait(20.0), 2);
  EXPECT_NE(refused.output().find("wlan77"), std::string::npos) << refused.output();
  Program printed({"safety_gate", "--config", file.string(), "--interface", "lo", "--print-params"},
                  folder.path / "printed");
  EXPECT_EQ(printed.wait(20.0), 0) << printed.output();
}

}  // namespace
}  // namespace foretrack
