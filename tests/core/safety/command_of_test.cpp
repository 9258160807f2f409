// SPDX-License-Identifier: Apache-2.0
#include "core/safety/command_of.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

TEST(CommandOf, NothingIsNoCommandAndAnotherHomeNeedsAPlace) {
  EXPECT_FALSE(command_of(AutopilotRequest::kNone, 1));
  EXPECT_FALSE(command_of(AutopilotRequest::kHome, 1));
}

TEST(CommandOf, ArmingIsAsIfByHandAndNeverForced) {
  const auto command = command_of(AutopilotRequest::kArm, 7);
  ASSERT_TRUE(command);
  EXPECT_EQ(command->kind, CommandKind::kArm);
  EXPECT_FALSE(command->forced);
  EXPECT_EQ(command->target_system, 7);
}

TEST(CommandOf, EverythingElseIsTheModeOfItsName) {
  const std::pair<AutopilotRequest, FlightMode> modes[] = {
      {AutopilotRequest::kOffboard, FlightMode::kOffboard},
      {AutopilotRequest::kReturn, FlightMode::kReturn},
      {AutopilotRequest::kLand, FlightMode::kLand},
      {AutopilotRequest::kTakeOff, FlightMode::kTakeOff},
      {AutopilotRequest::kHold, FlightMode::kHold}};
  for (const auto& [request, mode] : modes) {
    const auto command = command_of(request, 3);
    ASSERT_TRUE(command) << to_string(request);
    EXPECT_EQ(command->kind, CommandKind::kMode) << to_string(request);
    EXPECT_EQ(command->mode, mode) << to_string(request);
    EXPECT_EQ(command->target_system, 3);
  }
}

}  // namespace
}  // namespace foretrack
