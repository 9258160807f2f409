// SPDX-License-Identifier: Apache-2.0
// Registered modes as PX4's commander keeps them: eight numbers, a question each 0.3 s, three
// without an answer and the mode is unresponsive, and forgotten unless it is selected. Requests
// while armed are refused.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "px4_msgs/msg/ArmingCheckReply.h"
#include "px4_msgs/msg/ArmingCheckRequest.h"
#include "px4_msgs/msg/RegisterExtComponentReply.h"
#include "px4_msgs/msg/RegisterExtComponentRequest.h"
#include "px4_msgs/msg/UnregisterExtComponent.h"

namespace foretrack::testing {

class ModeKeeper {
 public:
  static constexpr int kFirst = 23;

  px4_msgs::msg::RegisterExtComponentReply take(
      const px4_msgs::msg::RegisterExtComponentRequest& request, bool armed) {
    px4_msgs::msg::RegisterExtComponentReply reply;
    reply.request_id(request.request_id());
    reply.name(request.name());
    reply.px4_ros2_api_version(1);
    reply.mode_id(-1);
    reply.arming_check_id(-1);
    reply.mode_executor_id(-1);
    for (int i = 0; i < 8 && !armed && !reply.success(); ++i) {
      if (modes_[i].valid) continue;
      modes_[i] = {.valid = true, .name = request.name()};
      reply.success(true);
      reply.mode_id(static_cast<std::int8_t>(kFirst + i));
      reply.arming_check_id(static_cast<std::int8_t>(i));
    }
    return reply;
  }
  void take(const px4_msgs::msg::UnregisterExtComponent& message) {
    const int i = message.mode_id() - kFirst;
    if (i >= 0 && i < 8 && modes_[i].name == message.name()) modes_[i].valid = false;
  }
  void take(const px4_msgs::msg::ArmingCheckReply& reply) {
    if (reply.request_id() != question_ || reply.registration_id() >= 8) return;
    Mode& mode = modes_[reply.registration_id()];
    mode.silent = 0;
    mode.answered = true;
    mode.can_run = reply.can_arm_and_run();
  }
  /// The next question, when it is due.
  std::optional<px4_msgs::msg::ArmingCheckRequest> ask(double now_s, int selected) {
    if (selectable() == 0 || now_s - asked_s_ < 0.3) return std::nullopt;
    asked_s_ = now_s;
    for (int i = 0; i < 8; ++i) {
      const bool silent = ++modes_[i].silent > (modes_[i].answered ? 3 : 10);
      if (silent && selected != kFirst + i) modes_[i].valid = false;
    }
    px4_msgs::msg::ArmingCheckRequest request;
    request.request_id(++question_);
    return request;
  }
  bool can_run(int number) const {
    const Mode& mode = modes_[number - kFirst];
    return mode.valid && mode.answered && mode.can_run && mode.silent <= 3;
  }
  std::uint32_t selectable() const {
    std::uint32_t mask = 0;
    for (int i = 0; i < 8; ++i) mask |= modes_[i].valid ? 1u << (kFirst + i) : 0u;
    return mask;
  }
  /// PX4 is started anew.
  void restart() { *this = ModeKeeper(); }

 private:
  struct Mode {
    bool valid = false;
    std::array<char, 25> name{};
    bool answered = false, can_run = false;
    int silent = 0;  // questions without an answer
  };
  std::array<Mode, 8> modes_{};
  std::uint8_t question_ = 0;
  double asked_s_ = -1e9;
};

}  // namespace foretrack::testing
