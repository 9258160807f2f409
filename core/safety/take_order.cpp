// SPDX-License-Identifier: Apache-2.0
#include "core/safety/take_order.hpp"

#include <algorithm>

namespace foretrack {
namespace {

// The newest order's word counts: a start that was stopped is not undone, a release is for good.
void note_what_to_undo(const OrderState& state, UnwrittenOrders& waits) {
  switch (state.last.order) {
    case MissionOrder::kLease:
      if (!waits.lease) waits.before.lease = state.before.lease;
      waits.lease = true;
      return;
    case MissionOrder::kRelease:
      waits.lease = false;
      return;
    case MissionOrder::kSetBounds:
      if (!waits.bounds) waits.before.bounds = state.before.bounds;
      waits.bounds = true;
      return;
    case MissionOrder::kFollow:
      if (!waits.person) waits.before.person = state.before.person;
      waits.person = true;
      return;
    case MissionOrder::kSetFraming:
      if (!waits.framing) waits.before.framing = state.before.framing;
      waits.framing = true;
      return;
    default:
      waits.phase = needs_memory(state.last.order);
  }
}

void undo(const UnwrittenOrders& waits, Mission& mission, CarryOut& carrying) {
  if (waits.lease) mission.lease = waits.before.lease;
  if (waits.bounds) mission.bounds = waits.before.bounds;
  if (waits.person) mission.person = waits.before.person;
  if (waits.framing) mission.framing = waits.before.framing;
  if (waits.phase && is_active(mission.phase))
    hold_mission(carrying, mission, MissionEnd::kUnwritten);
}

bool is_undone(const UnwrittenOrders& waits, MissionOrder order) {
  switch (order) {
    case MissionOrder::kLease:
      return waits.lease;
    case MissionOrder::kSetBounds:
      return waits.bounds;
    case MissionOrder::kFollow:
      return waits.person;
    case MissionOrder::kSetFraming:
      return waits.framing;
    default:
      return waits.phase && needs_memory(order);
  }
}

void drop_oldest(UnwrittenOrders& waits) {
  std::shift_left(waits.orders.begin(), waits.orders.begin() + waits.count, 1);
  --waits.count;
  waits.decided = std::max(waits.decided - 1, 0);
}

}  // namespace

void take_order(OrderState& state, Mission& mission, CarryOut& carrying,
                const MissionCommand& command, const Moment& moment, const AutopilotStatus& status,
                const MissionRules& rules, const MovingBodies* bodies) {
  state.before = mission;
  state.last = command;
  state.result = apply(command, mission, moment, rules, bodies);
  const bool about_phase = command.order != MissionOrder::kLease &&
                           command.order != MissionOrder::kRelease && !is_setting(command.order);
  if (state.result == MissionResult::kAccepted && about_phase)
    begin_phase(carrying, moment.now_s, status);
}

void await_writing(OrderState& state, const GateMemory& memory, bool is_news) {
  UnwrittenOrders& waits = state.unwritten;
  const bool others_wait = waits.any_is_being_written();
  if (state.result != MissionResult::kAccepted || !(is_news || others_wait)) return;
  if (!others_wait) waits.phase = waits.lease = waits.bounds = waits.person = waits.framing = false;
  if (is_news) note_what_to_undo(state, waits);
  if (waits.count == UnwrittenOrders::kCapacity) drop_oldest(waits);
  waits.orders[waits.count++] = {state.last, MissionResult::kPending};
  waits.revision = memory.revision;
  state.result = MissionResult::kPending;
}

void settle_orders(OrderState& state, Mission& mission, CarryOut& carrying,
                   const MemoryWriting& writing) {
  UnwrittenOrders& waits = state.unwritten;
  if (!waits.any_is_being_written()) return;
  const bool written = writing.written_revision >= waits.revision;
  if (!written && writing.failed_revision < waits.revision) return;
  if (!written) undo(waits, mission, carrying);
  for (; waits.decided < waits.count; ++waits.decided) {
    auto& [command, result] = waits.orders[waits.decided];
    if (written)
      result = MissionResult::kAccepted;
    else
      result = is_undone(waits, command.order) ? MissionResult::kRefusedUnwritten
                                               : MissionResult::kAcceptedUnwritten;
  }
}

void answer_order(OrderState& state) {
  UnwrittenOrders& waits = state.unwritten;
  if (waits.decided == 0) return;
  state.last = waits.orders[0].command;
  state.result = waits.orders[0].result;
  drop_oldest(waits);
}

}  // namespace foretrack
