// SPDX-License-Identifier: Apache-2.0
#include "core/safety/take_order.hpp"

namespace foretrack {
namespace {

void undo(const OrderState& state, Mission& mission, CarryOut& carrying) {
  switch (state.last.order) {
    case MissionOrder::kLease:
      mission.lease = state.before.lease;
      return;
    case MissionOrder::kSetBounds:
      mission.bounds = state.before.bounds;
      return;
    default:  // start, resume, take-off
      if (is_active(mission.phase)) hold_mission(carrying, mission, MissionEnd::kUnwritten);
  }
}

}  // namespace

void take_order(OrderState& state, Mission& mission, CarryOut& carrying,
                const MissionCommand& command, const Moment& moment, const AutopilotStatus& status,
                const MissionRules& rules) {
  state.before = mission;
  state.last = command;
  state.result = apply(command, mission, moment, rules);
  const bool about_phase = command.order != MissionOrder::kLease &&
                           command.order != MissionOrder::kRelease &&
                           command.order != MissionOrder::kSetBounds;
  if (state.result == MissionResult::kAccepted && about_phase)
    begin_phase(carrying, moment.now_s, status);
}

void await_writing(OrderState& state, const GateMemory& memory, bool is_news) {
  if (state.result != MissionResult::kAccepted || !is_news) return;
  state.result = MissionResult::kPending;
  state.revision = memory.revision;
}

void settle_order(OrderState& state, Mission& mission, CarryOut& carrying,
                  const MemoryWriting& writing) {
  if (state.result != MissionResult::kPending) return;
  if (writing.written_revision >= state.revision) {
    state.result = MissionResult::kAccepted;
  } else if (writing.failed_revision >= state.revision) {
    const bool undone = needs_memory(state.last.order);
    state.result = undone ? MissionResult::kRefusedUnwritten : MissionResult::kAcceptedUnwritten;
    if (undone) undo(state, mission, carrying);
  }
}

}  // namespace foretrack
