// SPDX-License-Identifier: Apache-2.0
#include "services/common/identity.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "foretrack_msgs/msg/MissionCommand.h"
#include "foretrack_msgs/msg/TargetState.h"
#include "services/common/reader.hpp"
#include "services/common/topics.hpp"
#include "services/common/writer.hpp"
#include "tests/services/common/bus.hpp"

namespace foretrack::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Made once; it takes a second.
const fs::path& enclaves() {
  static const fs::path kFolder = [] {
    const fs::path store = fs::temp_directory_path() / ("keystore-" + std::to_string(getpid()));
    const std::string command =
        "python3 " FORETRACK_SOURCE_DIR "/tests/support/keystore.py " + store.string();
    if (std::system(command.c_str()) != 0) throw std::runtime_error("no keystore");
    std::atexit([] {
      fs::remove_all(fs::temp_directory_path() / ("keystore-" + std::to_string(getpid())));
    });
    return store / "enclaves";
  }();
  return kFolder;
}

NodeOptions secured(const std::string& service, const std::string& identity) {
  auto options = node_options(service);
  options.security = enclaves() / identity;
  return options;
}

TEST(Identity, SaysInOneLineWhatIsWrong) {
  EXPECT_THAT(fault_of_identity(enclaves() / "vehicle"), IsEmpty());
  EXPECT_THAT(fault_of_identity("/nowhere"), HasSubstr("there is no folder /nowhere"));
  EXPECT_THAT(fault_of_identity(enclaves() / "expired"), HasSubstr("is no longer valid"));
  const fs::path copy = enclaves() / "copy";
  const auto spoiled = [&](const char* file, const char* of) {
    fs::remove_all(copy);
    fs::copy(enclaves() / "vehicle", copy);
    fs::remove(copy / file);
    if (*of) fs::copy_file(enclaves() / of / file, copy / file);
    return fault_of_identity(copy);
  };
  EXPECT_THAT(spoiled("permissions.p7s", ""), HasSubstr("permissions.p7s is missing"));
  EXPECT_THAT(spoiled("key.pem", "viewer"), HasSubstr("key.pem is not the key of cert.pem"));
  EXPECT_THAT(spoiled("identity_ca.cert.pem", "stranger"), HasSubstr("was not issued by"));
  fs::remove(copy / "cert.pem");
  std::ofstream(copy / "cert.pem") << "nothing";
  EXPECT_THAT(fault_of_identity(copy), HasSubstr("cert.pem is no certificate"));
}

TEST(Identity, ANodeWithAWrongOneSaysSo) {
  EXPECT_THROW(Node(secured("any", "expired")), std::invalid_argument);
  // What only DDS can see: permissions of somebody else.
  const fs::path copy = enclaves() / "mixed";
  fs::copy(enclaves() / "vehicle", copy);
  fs::remove(copy / "permissions.p7s");
  fs::copy_file(enclaves() / "viewer" / "permissions.p7s", copy / "permissions.p7s");
  try {
    Node node(secured("any", "mixed"));
    FAIL() << "it joined";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("permissions.p7s has no grant for CN=vehicle"));
  }
  EXPECT_THAT(refusal_of_identity(enclaves() / "vehicle"), HasSubstr("not for this domain"));
  fs::remove(copy / "permissions_ca.cert.pem");
  fs::copy_file(copy / "identity_ca.cert.pem", copy / "permissions_ca.cert.pem");
  EXPECT_THAT(refusal_of_identity(copy), HasSubstr("was not signed by permissions_ca.cert.pem"));
}

TEST(Identity, ThoseOfOneAuthorityMeetAndOthersDoNot) {
  Node gate(secured("gate", "vehicle"));
  EXPECT_TRUE(gate.secured());
  Node station(secured("station", "operator"));
  Node stranger(secured("stranger", "stranger"));
  Node open(node_options("open"));
  EXPECT_FALSE(open.secured());
  Writer<topics::TargetState> writer(station);
  Reader<topics::TargetState> reader(gate), of_stranger(stranger), of_open(open);
  ASSERT_TRUE(eventually([&] { return reader.writers() == 1; }, 20.0));
  EXPECT_TRUE(eventually([&] {
    writer.write();
    return reader.take_newest() != nullptr;
  }));
  EXPECT_EQ(of_stranger.writers(), 0);
  EXPECT_EQ(of_open.writers(), 0);
  for (const Node* one : {&gate, &station})
    for (const auto& [reason, count] : one->wire().refused_by_reason())
      if (reason != wire::word(wire::Fault::kStranger) &&
          reason != wire::word(wire::Fault::kIdentity))  // the two who do not belong
        ADD_FAILURE() << count << " of " << reason << ": security's own messages must pass";
}

TEST(Identity, WhoMayOnlyLookLooksAndWritesNothing) {
  Node gate(secured("gate", "vehicle"));
  Writer<topics::TargetState> writer(gate);
  Node viewer(secured("viewer", "viewer"));
  Reader<topics::TargetState> reader(viewer);
  EXPECT_THROW(
      viewer.add_writer(topics::MissionCommand::info, type_ops<topics::MissionCommand::Type>()),
      std::runtime_error);
  ASSERT_TRUE(eventually([&] { return reader.writers() == 1; }, 20.0));
  EXPECT_TRUE(eventually([&] {
    writer.write();
    return reader.take_newest() != nullptr;
  }));
}

}  // namespace
}  // namespace foretrack::testing
