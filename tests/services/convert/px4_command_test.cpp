// SPDX-License-Identifier: Apache-2.0
#include "services/convert/px4_command.hpp"

#include <gtest/gtest.h>

#include "tests/services/convert/convert_test_support.hpp"

namespace foretrack {
namespace {

namespace msg = px4_msgs::msg;

TEST(VehicleCommand, EachThatWeSendRoundTrips) {
  std::vector<AutopilotCommand> commands = {{.kind = CommandKind::kArm, .target_system = 3},
                                            {.kind = CommandKind::kDisarm},
                                            {.kind = CommandKind::kDisarm, .forced = true}};
  for (const auto mode : {FlightMode::kOffboard, FlightMode::kHold, FlightMode::kTakeOff,
                          FlightMode::kReturn, FlightMode::kLand, FlightMode::kPilot})
    commands.push_back({.mode = mode, .target_system = 2});
  for (const auto& command : commands) {
    msg::VehicleCommand m;
    to_idl(command, 1.0, m);
    EXPECT_TRUE(m.from_external());
    const auto out = from_idl(m);
    ASSERT_TRUE(out) << out.fault().text;
    EXPECT_EQ(out->kind, command.kind);
    EXPECT_EQ(out->forced, command.forced);
    EXPECT_EQ(out->target_system, command.target_system);
    EXPECT_TRUE(command.kind != CommandKind::kMode || out->mode == command.mode);
  }
}

TEST(VehicleCommand, RefusesWhatWeNeverAskFor) {
  using M = msg::VehicleCommand;
  M good;
  to_idl(AutopilotCommand{.kind = CommandKind::kArm}, 1.0, good);
  testing::expect_each_refused<M>(good,
                                  {
                                      {"command", [](M& m) { m.command(16); }},
                                      {"param1", [](M& m) { m.param1(0.5f); }},
                                      {"param2", [](M& m) { m.command(176), m.param2(1.0f); }},
                                  },
                                  [](const M& m) { return from_idl(m); });
}

TEST(VehicleCommandAck, AnswersItsOwnCommandAlone) {
  msg::VehicleCommand ours;
  to_idl(AutopilotCommand{.mode = FlightMode::kLand, .target_system = 5}, 1.0, ours);
  msg::VehicleCommandAck ack;
  to_ack(ours, CommandResult::kDenied, 2.0, ack);
  EXPECT_TRUE(answers(ack, ours));
  EXPECT_EQ(result_of(ack), CommandResult::kDenied);
  msg::VehicleCommand station = ours;
  station.source_component(190);
  EXPECT_FALSE(answers(ack, station));
  msg::VehicleCommand other = ours;
  other.command(22);
  EXPECT_FALSE(answers(ack, other));
}

TEST(VehicleCommandAck, AnUnknownResultIsAFailure) {
  msg::VehicleCommandAck ack;
  ack.result(9);
  EXPECT_EQ(result_of(ack), CommandResult::kFailed);
}

}  // namespace
}  // namespace foretrack
