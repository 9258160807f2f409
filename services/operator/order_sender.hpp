// SPDX-License-Identifier: Apache-2.0
// One order to one vehicle, without a lease, and what its gate makes of it.
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

namespace foretrack {

class OrderSender {
 public:
  OrderSender(Node& node, MissionOrder order, std::string operator_name);

  /// Call it about twenty times a second. Sends once the gate is heard, by the gate's own clock,
  /// and again each second, STOP ten times a second, until the gate has answered.
  void update();
  /// None: not yet answered.
  std::optional<MissionResult> result() const { return result_; }
  /// The gate's last words about itself; empty: it was not heard.
  const std::string& gate_text() const { return gate_text_; }

 private:
  void send(double now_s);

  MissionOrder order_;
  std::string operator_name_;
  Writer<topics::MissionCommand> writer_;
  Reader<topics::SafetyState> reader_;
  builtin_interfaces::msg::Time gate_stamp_;
  std::string gate_text_;
  double next_s_ = 0.0;
  std::vector<std::uint64_t> sent_;
  std::optional<MissionResult> result_;
};

/// The order of that name ("take_off"); none: there is no such order, or it needs a lease.
std::optional<MissionOrder> order_of(std::string_view name);

}  // namespace foretrack
