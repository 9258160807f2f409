// SPDX-License-Identifier: Apache-2.0
#include "services/operator/order_sender.hpp"

#include <algorithm>

#include "services/common/time_now.hpp"
#include "services/convert/safety.hpp"

namespace foretrack {
namespace {

constexpr double kAgain_s = 1.0;
constexpr double kRepeatStop_s = 0.1;
constexpr double kWriting_s = 3.0;  // that a slow disk may take; a second order would be refused

// Ids of one operator grow, also over several runs of a program.
std::uint64_t next_id(std::uint64_t last) {
  const auto now_us = static_cast<std::uint64_t>(now_ns() / 1000);
  return std::max(now_us, last + 1);
}

}  // namespace

OrderSender::OrderSender(Node& node, const MissionCommand& order)
    : order_(order),
      sending_(order.order),
      writer_(node),
      reader_(node),
      vehicle_(node.options().names.vehicle) {
  if (!is_setting(order.order)) return;
  lease_.emplace();
  sending_ = MissionOrder::kLease;
}

void OrderSender::update() {
  reader_.take_each([this](const foretrack_msgs::msg::SafetyState& state) {
    gate_stamp_ = state.header().stamp();
    gate_text_ = state.text().c_str();
    const auto phase = static_cast<MissionPhase>(state.phase());
    is_idle_ = phase == MissionPhase::kIdle;
    has_flown_ |= phase == MissionPhase::kTracking;
    is_overruled_ |= is_overruled(state);
    const auto result = static_cast<MissionResult>(state.command_result());
    if (std::ranges::find(sent_, state.command_id()) == sent_.end()) return;
    if (result == MissionResult::kPending)
      next_s_ = steady_s() + kWriting_s;
    else
      take_answer(result);
  });
  const double now_s = steady_s();
  if (insists_ && is_overruled_) {
    sending_.reset();
  } else if (insists_ && is_done() && is_idle_ && !has_flown_) {
    sending_ = order_.order;
    next_s_ = now_s + kAgain_s;
  }
  if (sending_ && !gate_text_.empty() && writer_.readers() > 0 && now_s >= next_s_) send(now_s);
}

// By whoever has the vehicle in hand, or by another order.
bool OrderSender::is_overruled(const foretrack_msgs::msg::SafetyState& state) const {
  const bool others =
      state.command_id() != 0 && std::ranges::find(given_, state.command_id()) == given_.end();
  switch (static_cast<MissionEnd>(state.mission_end())) {
    case MissionEnd::kPilot:
    case MissionEnd::kSticks:
    case MissionEnd::kOtherMode:
    case MissionEnd::kDisarmed:
    case MissionEnd::kTerminated:
      return true;
    default:
      return others;
  }
}

// What is answered is not asked again; the lease is given back whatever became of the setting.
void OrderSender::take_answer(MissionResult answer) {
  sent_.clear();
  next_s_ = 0.0;
  if (sending_ == MissionOrder::kLease && is_accepted(answer)) {
    sending_ = order_.order;
    return;
  }
  if (!result_) result_ = answer;
  const bool gives_back = lease_ && sending_ == order_.order;
  sending_ = gives_back ? std::optional(MissionOrder::kRelease) : std::nullopt;
}

void OrderSender::send(double now_s) {
  next_s_ = now_s + (sending_ == MissionOrder::kStop ? kRepeatStop_s : kAgain_s);
  last_id_ = next_id(last_id_);
  auto& order = writer_.sample();
  order_.id = last_id_;
  to_idl(order_, order);
  order.command(static_cast<std::uint8_t>(*sending_));  // or about the lease for it
  order.header().stamp(gate_stamp_);
  if (lease_) lease_->sign(vehicle_, order);
  sent_.push_back(last_id_);
  given_.push_back(last_id_);
  writer_.write();
}

}  // namespace foretrack
