// SPDX-License-Identifier: Apache-2.0
// The mode "Follow" of the flight controller: registered, answered for, completed, unregistered.
#pragma once

#include <optional>
#include <string>

#include "core/safety/gate.hpp"
#include "core/safety/register_mode.hpp"
#include "px4_msgs/msg/ArmingCheckReply.h"
#include "px4_msgs/msg/ArmingCheckRequest.h"
#include "px4_msgs/msg/ModeCompleted.h"
#include "px4_msgs/msg/RegisterExtComponentReply.h"
#include "px4_msgs/msg/RegisterExtComponentRequest.h"
#include "px4_msgs/msg/UnregisterExtComponent.h"
#include "px4_msgs/msg/VehicleStatus.h"
#include "services/common/service.hpp"

namespace foretrack {

class FollowModeLink {
 public:
  explicit FollowModeLink(Service& service);
  /// Unregisters the mode.
  ~FollowModeLink();
  FollowModeLink(const FollowModeLink&) = delete;
  FollowModeLink& operator=(const FollowModeLink&) = delete;

  /// Of each status that comes, before it is used.
  void hear(const px4_msgs::msg::VehicleStatus& message, AutopilotStatus& status);
  /// Each tick: registers the mode if it is not, and tells of its end. `heard`: the flight
  /// controller, of late.
  void update(const GateResult& result, const AutopilotStatus& status, bool heard, double stamp_s);
  /// How it is with the mode, and why it cannot be selected.
  std::string words() const;

 private:
  void ask(double stamp_s);
  void take_answer(const px4_msgs::msg::RegisterExtComponentReply& reply);
  void answer(const px4_msgs::msg::ArmingCheckRequest& request);
  void tell_end(const GateResult& result, const AutopilotStatus& status, double stamp_s);
  bool is_registered() const;

  Service& service_;
  Reader<topics::Px4RegisterReply> reply_reader_;
  Reader<topics::Px4ArmingCheckRequest> check_reader_;
  Writer<topics::Px4RegisterRequest> request_;
  Writer<topics::Px4ArmingCheckReply> check_;
  Writer<topics::Px4ModeCompleted> completed_;
  Writer<topics::Px4Unregister> unregister_;
  ModeRegistration registration_;
  std::optional<RegistrationAnswer> answer_;  // that came since the last tick
  std::uint32_t selectable_ = 0;
  // PX4 takes off by our setpoints in offboard mode, and not in a registered one.
  bool has_taken_off_ = false;
  double matched_s_ = -1.0;  // since when both sides hear each other; < 0: not known
  ModeHindrance hindrance_ = ModeHindrance::kNotReady;
  SafetyReason reason_ = SafetyReason::kNone;
  bool flew_ = false;  // in the last tick, in this mode
};

}  // namespace foretrack
