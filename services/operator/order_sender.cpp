// SPDX-License-Identifier: Apache-2.0
#include "services/operator/order_sender.hpp"

#include <algorithm>

#include "services/common/time_now.hpp"

namespace foretrack {
namespace {

constexpr double kAgain_s = 1.0;
constexpr double kRepeatStop_s = 0.1;
constexpr double kWriting_s = 3.0;  // that a slow disk may take; a second order would be refused

// Ids of one operator grow, also over several runs of a program.
std::uint64_t next_id(const std::vector<std::uint64_t>& sent) {
  const auto now_us = static_cast<std::uint64_t>(now_ns() / 1000);
  return std::max(now_us, sent.empty() ? 1 : sent.back() + 1);
}

}  // namespace

OrderSender::OrderSender(Node& node, MissionOrder order, std::string operator_name)
    : order_(order), operator_name_(std::move(operator_name)), writer_(node), reader_(node) {}

void OrderSender::update() {
  reader_.take_each([this](const foretrack_msgs::msg::SafetyState& state) {
    gate_stamp_ = state.header().stamp();
    gate_text_ = state.text().c_str();
    const auto result = static_cast<MissionResult>(state.command_result());
    const bool is_ours = std::ranges::find(sent_, state.command_id()) != sent_.end();
    if (is_ours && result != MissionResult::kPending) result_ = result;
    if (is_ours && result == MissionResult::kPending) next_s_ = steady_s() + kWriting_s;
  });
  const double now_s = steady_s();
  if (!result_ && !gate_text_.empty() && writer_.readers() > 0 && now_s >= next_s_) send(now_s);
}

void OrderSender::send(double now_s) {
  next_s_ = now_s + (order_ == MissionOrder::kStop ? kRepeatStop_s : kAgain_s);
  auto& order = writer_.sample();
  order.header().stamp(gate_stamp_);
  order.id(next_id(sent_));
  order.command(static_cast<std::uint8_t>(order_));
  order.operator_id(operator_name_);
  sent_.push_back(order.id());
  writer_.write();
}

std::optional<MissionOrder> order_of(std::string_view name) {
  for (const auto order :
       {MissionOrder::kStart, MissionOrder::kHold, MissionOrder::kResume, MissionOrder::kReturn,
        MissionOrder::kLand, MissionOrder::kStop, MissionOrder::kTakeOff})
    if (to_string(order) == name) return order;
  return std::nullopt;
}

}  // namespace foretrack
