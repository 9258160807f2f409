// SPDX-License-Identifier: Apache-2.0
// Who may say what, on a real bus.
#include "services/common/roles.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "foretrack_msgs/msg/MissionCommand.h"
#include "foretrack_msgs/msg/PlannedTrajectory.h"
#include "foretrack_msgs/msg/TargetState.h"
#include "nav_msgs/msg/Odometry.h"
#include "px4_msgs/msg/TrajectorySetpoint.h"
#include "px4_msgs/msg/VehicleCommand.h"
#include "services/common/reader.hpp"
#include "services/common/topics.hpp"
#include "services/common/writer.hpp"
#include "tests/services/common/bus.hpp"
#include "tests/support/keys.hpp"

namespace foretrack::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::uint64_t refusals(const Node& node, wire::Fault fault) {
  for (const auto& [reason, count] : node.wire().refused_by_reason())
    if (reason == wire::word(fault)) return count;
  return 0;
}

template <class Topic>
bool may_write(Node& node) {
  try {
    node.add_writer(Topic::info, type_ops<typename Topic::Type>());
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("DDS refuses to write"));
    return false;
  }
  return true;
}

/// The vehicle's keys; one for all tests, as they are not changed but by adding.
class SecuredBus : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    log_dds();
    keys_ = std::make_unique<Keys>();
  }
  static void TearDownTestSuite() { keys_.reset(); }
  static NodeOptions as(const std::string& folder) {
    auto options = node_options(fs::path(folder).filename());
    options.security = folder;
    return options;
  }
  static inline std::unique_ptr<Keys> keys_;
};

TEST_F(SecuredBus, EachWritesWhatItsRoleMayAndNothingElse) {
  Node gate(as(keys_->issue(Role::kGate))), vehicle(as(keys_->issue(Role::kVehicle)));
  Node front_end(as(keys_->issue(Role::kFrontEnd))), operators(as(keys_->issue(Role::kOperator)));
  Node viewer(as(keys_->issue(Role::kViewer)));
  EXPECT_TRUE(may_write<topics::Px4TrajectorySetpoint>(gate));
  EXPECT_TRUE(may_write<topics::PlannedTrajectory>(vehicle));
  EXPECT_TRUE(may_write<topics::Odometry>(front_end));
  EXPECT_TRUE(may_write<topics::MissionCommand>(operators));
  for (Node* other : {&vehicle, &front_end, &operators, &viewer}) {
    EXPECT_FALSE(may_write<topics::Px4TrajectorySetpoint>(*other)) << other->options().service;
    EXPECT_FALSE(may_write<topics::Px4VehicleCommand>(*other)) << other->options().service;
  }
  for (Node* other : {&gate, &vehicle, &front_end, &viewer})
    EXPECT_FALSE(may_write<topics::MissionCommand>(*other)) << other->options().service;
  EXPECT_FALSE(may_write<topics::PlannedTrajectory>(gate));
  EXPECT_FALSE(may_write<topics::Odometry>(vehicle));
}

/// The gate's inputs and the flight controller's.
struct Inputs {
  explicit Inputs(Node& node)
      : order(node), plan(node), target(node), odometry(node), setpoint(node) {}
  bool heard() {
    return order.take_newest() || plan.take_newest() || target.take_newest() ||
           odometry.take_newest() || setpoint.take_newest();
  }
  int writers() const {
    return order.writers() + plan.writers() + target.writers() + odometry.writers() +
           setpoint.writers();
  }
  Reader<topics::MissionCommand> order;
  Reader<topics::PlannedTrajectory> plan;
  Reader<topics::TargetState> target;
  Reader<topics::Odometry> odometry;
  Reader<topics::Px4TrajectorySetpoint> setpoint;
};

/// Somebody who writes all of them.
struct Intruder {
  explicit Intruder(const NodeOptions& options)
      : node(options), order(node), plan(node), target(node), odometry(node), setpoint(node) {}
  void write() { order.write(), plan.write(), target.write(), odometry.write(), setpoint.write(); }
  Node node;
  Writer<topics::MissionCommand> order;
  Writer<topics::PlannedTrajectory> plan;
  Writer<topics::TargetState> target;
  Writer<topics::Odometry> odometry;
  Writer<topics::Px4TrajectorySetpoint> setpoint;
};

// Until the alarm, and then as long as a friend needs to be heard.
void expect_no_effect(Node& node, Inputs& inputs, Intruder& intruder, wire::Fault alarm,
                      std::uint64_t times = 1) {
  EXPECT_TRUE(eventually(
      [&] {
        intruder.write();
        EXPECT_FALSE(inputs.heard());
        return refusals(node, alarm) >= times;
      },
      20.0))
      << wire::word(alarm);
  EXPECT_EQ(inputs.writers(), 0);
  // It is counted first, and told then.
  eventually([&] { return node.last_error().find(wire::word(alarm)) != std::string::npos; }, 5.0);
  EXPECT_THAT(node.last_error(), HasSubstr(wire::word(alarm)));
}

TEST_F(SecuredBus, WhoHasNoIdentityHasNoEffectAndRaisesAnAlarm) {
  Node gate(as(keys_->issue(Role::kGate)));
  Inputs inputs(gate);
  Intruder intruder(node_options("intruder"));
  expect_no_effect(gate, inputs, intruder, wire::Fault::kStranger);
}

TEST_F(SecuredBus, SomebodyOfAnotherAuthorityAsOfSimulationsIsTheSame) {
  Keys simulated(true);
  Node gate(as(keys_->issue(Role::kGate)));
  Inputs inputs(gate);
  Node simulator(as(simulated.issue(Role::kSimulator)));
  Writer<topics::Odometry> odometry(simulator);
  EXPECT_TRUE(eventually(
      [&] {
        odometry.write();
        return refusals(gate, wire::Fault::kIdentity) > 0;
      },
      20.0));
  EXPECT_EQ(inputs.odometry.writers(), 0);
}

// The library of an honest peer refuses such writers itself. This one's is deceived: there is a
// rule for another domain, which it does not look at, and others do.
std::string identity_that_deceives_its_library(Keys& keys) {
  const fs::path folder = keys.issue(Role::kViewer, "liar");
  const auto own = keys.store.folder();
  const security::Authority authority{read_key(own / "private/permissions_ca.key.pem"),
                                      read_certificate(own / "public/permissions_ca.cert.pem")};
  security::Grant grant{"CN=/uav1/viewer-liar", Role::kViewer, {}, valid_days(-1, 1), domain_id()};
  std::string text = security::permissions_text(grant);
  constexpr char kElsewhere[] =
      "<allow_rule><domains><id>232</id></domains><publish><topics><topic>*</topic></topics>"
      "</publish><subscribe><topics><topic>*</topic></topics></subscribe></allow_rule>\n";
  text.insert(text.find("<allow_rule>"), kElsewhere);
  std::ofstream(folder / "permissions.p7s") << security::signed_document(authority, text);
  return folder;
}

TEST_F(SecuredBus, AWrongRoleHasNoEffectAndRaisesAnAlarmEvenIfItsOwnLibraryLetsIt) {
  Node gate(as(keys_->issue(Role::kGate)));
  Inputs inputs(gate);
  Intruder intruder(as(identity_that_deceives_its_library(*keys_)));
  constexpr int kTopics = 5;
  expect_no_effect(gate, inputs, intruder, wire::Fault::kRole, kTopics);
}

TEST_F(SecuredBus, ARevokedIdentityIsRefusedByWhoKnowsAndRaisesAnAlarm) {
  Keys keys;
  const fs::path folder = keys.issue(Role::kVehicle), stolen = keys.folder.path / "stolen";
  fs::copy(folder, stolen);
  keys.store.revoke("uav1/vehicle", false);
  EXPECT_THROW(Node(as(folder)), std::invalid_argument);
  Node gate(as(keys.issue(Role::kGate)));
  Inputs inputs(gate);
  Node thief(as(stolen));  // it kept the former list
  Writer<topics::PlannedTrajectory> plan(thief);
  EXPECT_TRUE(eventually([&] { return refusals(gate, wire::Fault::kIdentity) > 0; }, 20.0));
  EXPECT_EQ(inputs.plan.writers(), 0);
}

TEST_F(SecuredBus, APeerWithAFormerIdentityFliesOnThroughRotation) {
  Keys keys;
  Node gate(as(keys.issue(Role::kGate)));
  Reader<topics::PlannedTrajectory> reader(gate);
  const auto is_heard = [&](Node& node) {
    Writer<topics::PlannedTrajectory> plan(node);
    return eventually(
        [&] {
          plan.write();
          return reader.take_newest() != nullptr;
        },
        20.0);
  };
  Node before(as(keys.issue(Role::kVehicle)));
  EXPECT_TRUE(is_heard(before));
  keys.issue(Role::kGate);
  const auto renewed = keys.issue(Role::kVehicle);
  Node after(as(renewed));
  EXPECT_TRUE(is_heard(after)) << "renewed, by the gate that was not";
  keys.store.revoke("uav1/vehicle", true);
  EXPECT_TRUE(is_heard(before)) << "who met before the revocation is heard until one starts again";
}

}  // namespace
}  // namespace foretrack::testing
