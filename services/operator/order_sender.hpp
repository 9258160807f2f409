// SPDX-License-Identifier: Apache-2.0
// One order to one vehicle, and what its gate makes of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/safety/mission.hpp"
#include "foretrack_msgs/msg/MissionCommand.h"
#include "foretrack_msgs/msg/SafetyState.h"
#include "services/common/reader.hpp"
#include "services/common/topics.hpp"
#include "services/common/writer.hpp"
#include "services/convert/order_proof.hpp"

namespace foretrack {

/// Without a lease; but settings are made under one, which is taken for them and given back.
class OrderSender {
 public:
  /// What is ordered, by whom; the rest of the command is filled in.
  OrderSender(Node& node, const MissionCommand& order);

  /// Call it about twenty times a second. Sends once the gate is heard, by the gate's own clock,
  /// and again each second, STOP ten times a second, until the gate has answered.
  void update();
  /// As an operator would who wants to see it fly: a start that is refused, or comes to nothing
  /// before the vehicle has flown, is given again. On a busy machine the first may come too late.
  /// A pilot's deed or somebody else's order ends that.
  void insist() { insists_ = true; }
  /// None: not yet answered.
  std::optional<MissionResult> result() const { return result_; }
  /// It is answered, and nothing is left to be given back.
  bool is_done() const { return result_ && !sending_; }
  /// The gate's last words about itself; empty: it was not heard.
  const std::string& gate_text() const { return gate_text_; }

 private:
  void send(double now_s);
  void take_answer(MissionResult answer);
  bool is_overruled(const foretrack_msgs::msg::SafetyState& state) const;

  MissionCommand order_;
  std::optional<LeaseKey> lease_;
  std::optional<MissionOrder> sending_;  // until it is answered
  Writer<topics::MissionCommand> writer_;
  Reader<topics::SafetyState> reader_;
  builtin_interfaces::msg::Time gate_stamp_;
  std::string gate_text_;
  double next_s_ = 0.0;
  std::string vehicle_;
  std::vector<std::uint64_t> sent_;   // and not yet answered
  std::vector<std::uint64_t> given_;  // ever
  std::uint64_t last_id_ = 0;
  std::optional<MissionResult> result_;
  bool insists_ = false, is_idle_ = false, has_flown_ = false, is_overruled_ = false;
};

}  // namespace foretrack
