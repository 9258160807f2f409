// SPDX-License-Identifier: Apache-2.0
#include "core/safety/command_of.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

TEST(CommandOf, EachRequestIsOneCommandToTheVehiclesOwnSystem) {
  EXPECT_FALSE(command_of(AutopilotRequest::kNone, 3));
  const auto arm = command_of(AutopilotRequest::kArm, 3);
  ASSERT_TRUE(arm);
  EXPECT_EQ(arm->kind, CommandKind::kArm);
  EXPECT_EQ(arm->target_system, 3);
  constexpr std::pair<AutopilotRequest, FlightMode> kModes[] = {
      {AutopilotRequest::kOffboard, FlightMode::kOffboard},
      {AutopilotRequest::kReturn, FlightMode::kReturn},
      {AutopilotRequest::kLand, FlightMode::kLand},
      {AutopilotRequest::kTakeOff, FlightMode::kTakeOff},
      {AutopilotRequest::kHold, FlightMode::kHold}};
  for (const auto& [request, mode] : kModes) {
    const auto command = command_of(request, 3);
    ASSERT_TRUE(command) << to_string(request);
    EXPECT_NE(command->kind, CommandKind::kArm) << to_string(request);
    EXPECT_EQ(command->mode, mode) << to_string(request);
    EXPECT_EQ(command->target_system, 3);
  }
}

}  // namespace
}  // namespace foretrack
