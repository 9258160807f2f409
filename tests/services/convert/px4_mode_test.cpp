// SPDX-License-Identifier: Apache-2.0
#include "services/convert/px4_mode.hpp"

#include <gtest/gtest.h>

#include "tests/services/convert/convert_test_support.hpp"

namespace foretrack {
namespace {

namespace msg = px4_msgs::msg;

msg::RegisterExtComponentReply reply_to(const msg::RegisterExtComponentRequest& request) {
  msg::RegisterExtComponentReply reply;
  reply.request_id(request.request_id());
  reply.name(request.name());
  reply.px4_ros2_api_version(request.px4_ros2_api_version());
  reply.success(true);
  reply.mode_id(23);
  reply.arming_check_id(2);
  reply.mode_executor_id(-1);
  return reply;
}

TEST(Px4Mode, ARegistrationAsksForAModeNamedFollowWithItsCheckAndNoExecutor) {
  msg::RegisterExtComponentRequest request;
  to_registration(77, "1.17", 2.5, request);
  EXPECT_STREQ(request.name().data(), "Follow");
  EXPECT_EQ(request.timestamp(), 2500000u);
  EXPECT_TRUE(request.register_mode() && request.register_arming_check());
  EXPECT_FALSE(request.register_mode_executor() || request.activate_mode_immediately() ||
               request.enable_replace_internal_mode());
  EXPECT_EQ(request.px4_ros2_api_version(), 1);
  to_registration(77, "1.18", 2.5, request);
  EXPECT_EQ(request.px4_ros2_api_version(), 2);
}

TEST(Px4Mode, OnlyTheAnswerToTheRequestCountsAndHasItsNumbers) {
  msg::RegisterExtComponentRequest request, other;
  to_registration(77, "1.16", 1.0, request);
  to_registration(78, "1.16", 1.0, other);
  const auto reply = reply_to(request);
  EXPECT_TRUE(answers(reply, request));
  EXPECT_FALSE(answers(reply, other));
  const auto answer = from_idl(reply, "1.16");
  ASSERT_TRUE(answer) << answer.fault().text;
  EXPECT_TRUE(answer->accepted);
  EXPECT_EQ(answer->numbers.mode, 23);
  EXPECT_EQ(answer->numbers.check, 2);
}

TEST(Px4Mode, ARefusalIsAnAnswerWhateverItsNumbers) {
  msg::RegisterExtComponentRequest request;
  to_registration(1, "1.16", 1.0, request);
  auto reply = reply_to(request);
  reply.success(false);
  reply.mode_id(-1);
  const auto answer = from_idl(reply, "1.16");
  ASSERT_TRUE(answer);
  EXPECT_FALSE(answer->accepted);
}

TEST(Px4Mode, RefusesNumbersOfNoModeAndOtherAgreements) {
  using M = msg::RegisterExtComponentReply;
  msg::RegisterExtComponentRequest request;
  to_registration(1, "1.16", 1.0, request);
  for (const auto& [field, spoil] : std::vector<std::pair<std::string, std::function<void(M&)>>>{
           {"mode_id", [](M& m) { m.mode_id(14); }},
           {"mode_id", [](M& m) { m.mode_id(31); }},
           {"arming_check_id", [](M& m) { m.arming_check_id(8); }},
           {"px4_ros2_api_version", [](M& m) { m.px4_ros2_api_version(2); }}}) {
    auto reply = reply_to(request);
    spoil(reply);
    const auto answer = from_idl(reply, "1.16");
    ASSERT_FALSE(answer) << field;
    EXPECT_EQ(answer.fault().field, field);
  }
}

TEST(Px4Mode, AReplyNamesTheRequestAndTheCheckAndNeedsNoRemoteControl) {
  msg::ArmingCheckRequest request;
  request.request_id(9);
  msg::ArmingCheckReply reply;
  to_reply(request, {23, 2}, true, 3.0, reply);
  EXPECT_EQ(reply.request_id(), 9);
  EXPECT_EQ(reply.registration_id(), 2);
  EXPECT_TRUE(reply.can_arm_and_run());
  EXPECT_TRUE(reply.mode_req_local_position() && reply.mode_req_attitude());
  EXPECT_FALSE(reply.mode_req_manual_control() || reply.mode_req_global_position() ||
               reply.mode_req_prevent_arming());
  to_reply(request, {23, 2}, false, 3.0, reply);
  EXPECT_FALSE(reply.can_arm_and_run());
}

TEST(Px4Mode, ItsNumberInTheStatusCountsAsOursAndAnotherOneDoesNot) {
  msg::VehicleStatus message;
  message.nav_state(23);
  message.nav_state_user_intention(23);
  AutopilotStatus status;
  mark_own_mode(message, 23, status);
  EXPECT_TRUE(status.own_mode && status.own_selected && status.offboard);
  EXPECT_EQ(status.mode, FlightMode::kOffboard);
  message.nav_state(5);  // a failsafe returns, and the choice stands
  status = {};
  mark_own_mode(message, 23, status);
  EXPECT_FALSE(status.own_mode || status.offboard);
  EXPECT_TRUE(status.own_selected);
}

}  // namespace
}  // namespace foretrack
