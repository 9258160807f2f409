// SPDX-License-Identifier: Apache-2.0
#include "services/security/keystore.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>

#include "services/security/inspect.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/keys.hpp"

namespace foretrack::security {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
namespace fs = std::filesystem;

int mode_of(const fs::path& file) {
  struct stat about {};
  stat(file.c_str(), &about);
  return about.st_mode & 0777;
}

TEST(Keystore, LaysFilesOutAsSros2DoesAndKeepsKeysToTheirOwner) {
  Keys keys;
  const fs::path gate = keys.issue(Role::kGate);
  EXPECT_EQ(gate, keys.folder.path / "keys/enclaves/uav1/gate");
  for (const char* file : {"private/identity_ca.key.pem", "private/permissions_ca.key.pem",
                           "enclaves/uav1/gate/key.pem"})
    EXPECT_EQ(mode_of(keys.store.folder() / file), 0600) << file;
  for (const char* file : {"public/identity_ca.cert.pem", "public/permissions_ca.cert.pem",
                           "public/crl.pem", "enclaves/governance.p7s"})
    EXPECT_TRUE(fs::exists(keys.store.folder() / file)) << file;
  EXPECT_THAT(fault_of_identity(gate), IsEmpty());
  EXPECT_EQ(subject_of(*read_certificate(gate / "cert.pem")), "CN=/uav1/gate");
  EXPECT_THAT(error_of([&] { return Keystore::create(keys.store.folder(), false, {}).folder(); }),
              HasSubstr("is a keystore already"));
  EXPECT_THAT(error_of([&] { return Keystore(keys.folder.path).folder(); }),
              HasSubstr("security init"));
}

TEST(Keystore, ItsPermissionsAreThoseOfTheTableOfTopics) {
  for (const Role role : kRoles) {
    const auto writable = writable_topics(role, Names{});
    const bool gate = role == Role::kGate;
    for (const char* topic : {"rt/fmu/in/trajectory_setpoint", "rt/fmu/in/vehicle_command",
                              "rt/fmu/in/offboard_control_mode", "rt/uav1/safety/state"})
      EXPECT_EQ(std::ranges::count(writable, topic), gate ? 1 : 0) << name_of(role) << topic;
    EXPECT_EQ(std::ranges::count(writable, "rt/uav1/mission/command"), role == Role::kOperator);
    EXPECT_EQ(std::ranges::count(writable, "rt/uav1/plan/trajectory"), role == Role::kVehicle);
    EXPECT_EQ(std::ranges::count(writable, "rt/clock"), role == Role::kSimulator);
  }
  EXPECT_THAT(writable_topics(Role::kViewer, Names{}), SizeIs(1))
      << "what ROS 2's tools ask of all";
  Names fleet, second;
  fleet.vehicle = kAllVehicles;
  second.px4_namespace = "px4_2";
  EXPECT_THAT(writable_topics(Role::kOperator, fleet), Contains("rt/*/mission/command"));
  EXPECT_THAT(writable_topics(Role::kAutopilot, second),
              Contains("rt/px4_2/fmu/out/vehicle_status_v*"));
}

TEST(Keystore, SignsWhatTheRoleMayWrite) {
  Keys keys;
  const fs::path folder = keys.issue(Role::kOperator, "ada");
  const auto authority = read_certificate(folder / "permissions_ca.cert.pem");
  const auto text = signed_text(folder / "permissions.p7s", *authority);
  EXPECT_THAT(text, HasSubstr("<subject_name>CN=/uav1/operator-ada</subject_name>"));
  EXPECT_THAT(text, HasSubstr("<topic>rt/uav1/mission/command</topic>"));
  EXPECT_THAT(text, Not(HasSubstr("plan/trajectory")));
  EXPECT_TRUE(demands_identity(folder));
}

TEST(Keystore, ASimulatorHasItsOwnAuthority) {
  Keys real, simulated(true);
  EXPECT_THAT(error_of([&] { return real.issue(Role::kSimulator); }),
              HasSubstr("would take its odometry for true"));
  const fs::path simulator = simulated.issue(Role::kSimulator);
  EXPECT_TRUE(Keystore(simulated.store.folder()).of_simulation());
  fs::copy_file(fs::path(real.issue(Role::kGate)) / "identity_ca.cert.pem",
                simulator / "identity_ca.cert.pem", fs::copy_options::overwrite_existing);
  EXPECT_THAT(fault_of_identity(simulator), HasSubstr("was not issued by"));
}

TEST(Keystore, WrongNamesAreRefused) {
  Keys keys;
  const auto issue = [&](const Identity& identity) {
    return error_of([&] { return keys.store.issue(identity, valid_days(-1, 1)); });
  };
  Names outside;
  outside.vehicle = "../uav";
  EXPECT_THAT(issue({.names = outside, .role = Role::kGate, .person = ""}),
              HasSubstr("vehicle name"));
  EXPECT_THAT(issue({.names = {}, .role = Role::kOperator, .person = "a/b"}), HasSubstr("a/b"));
}

TEST(Keystore, ExpiredAndRevokedIdentitiesAreNamed) {
  Keys keys;
  EXPECT_THAT(fault_of_identity(keys.issue(Role::kViewer, "old", valid_days(-3, -1))),
              HasSubstr("is no longer valid"));
  const std::string folder = keys.issue(Role::kOperator), other = keys.issue(Role::kGate);
  EXPECT_EQ(keys.store.revoke("uav1/operator", false), 1);
  EXPECT_THAT(fault_of_identity(folder), HasSubstr("was revoked"));
  EXPECT_THAT(fault_of_identity(other), IsEmpty());
  EXPECT_EQ(keys.issue(Role::kOperator), folder) << "who lost a key gets another one";
  EXPECT_THAT(fault_of_identity(folder), IsEmpty());
  EXPECT_THAT(error_of([&] { return keys.store.revoke("uav1/recorder", false); }),
              HasSubstr("there are uav1/gate, uav1/operator"));
}

TEST(Keystore, ARenewedIdentityLeavesTheFormerOneGoodUntilItIsRevoked) {
  Keys keys;
  const fs::path folder = keys.issue(Role::kVehicle), former = keys.folder.path / "former";
  fs::copy(folder, former);
  keys.issue(Role::kVehicle);
  EXPECT_THAT(fault_of_identity(former), IsEmpty());
  EXPECT_EQ(keys.store.revoke("uav1/vehicle", true), 1);
  EXPECT_THAT(fault_of_identity(folder), IsEmpty());
  fs::copy_file(keys.store.folder() / "public/crl.pem", former / "crl.pem",
                fs::copy_options::overwrite_existing);
  EXPECT_THAT(fault_of_identity(former), HasSubstr("was revoked"));
  EXPECT_EQ(keys.store.revoke("uav1/vehicle", true), 0);
}

TEST(Identities, AreTakenByTheRoleOfTheService) {
  Keys keys;
  const fs::path vehicle = fs::path(keys.issue(Role::kGate)).parent_path();
  keys.issue(Role::kViewer);
  EXPECT_EQ(identity_folder(vehicle, "safety_gate"), vehicle / "gate");
  EXPECT_EQ(identity_folder(vehicle, "station"), vehicle / "viewer") << "no operator is there";
  EXPECT_EQ(identity_folder(vehicle / "viewer", "safety_gate"), vehicle / "viewer") << "as told";
  EXPECT_THAT(error_of([&] { return identity_folder(vehicle, "planning"); }),
              HasSubstr("has no identity of vehicle, only"));
}

TEST(Inspect, SaysWhatIsWrongBeforeSomebodyFlies) {
  Keys keys;
  const fs::path gate = keys.issue(Role::kGate), vehicle = keys.issue(Role::kVehicle);
  const auto fault_of = [](const fs::path& folder) { return inspect(folder).front().fault; };
  EXPECT_THAT(inspect(keys.store.folder()), SizeIs(2));
  EXPECT_THAT(fault_of(gate), IsEmpty());
  EXPECT_THAT(inspect(gate).front().advice, HasSubstr("ends in 9 days"));
  fs::permissions(gate / "key.pem", fs::perms::group_read, fs::perm_options::add);
  EXPECT_THAT(fault_of(gate), HasSubstr("chmod 600"));
  fs::copy_file(gate / "permissions.p7s", vehicle / "permissions.p7s",
                fs::copy_options::overwrite_existing);
  EXPECT_THAT(fault_of(vehicle), HasSubstr("has no grant for CN=/uav1/vehicle"));
  std::ofstream(vehicle / "governance.p7s") << "nothing";
  EXPECT_THAT(fault_of(vehicle), HasSubstr("governance.p7s was not signed"));
  EXPECT_THAT(inspect(keys.folder.path / "nowhere"), IsEmpty());
}

}  // namespace
}  // namespace foretrack::security
