// SPDX-License-Identifier: Apache-2.0
#include "core/safety/take_order.hpp"

namespace foretrack {
namespace {

// The newest order's word counts: a start that was stopped is not undone, a release is for good.
void note_what_to_undo(const OrderState& state, UnwrittenOrders& waits) {
  switch (state.last.order) {
    case MissionOrder::kLease:
      if (!waits.lease) waits.lease_before = state.lease_before;
      waits.lease = true;
      return;
    case MissionOrder::kRelease:
      waits.lease = false;
      return;
    case MissionOrder::kSetBounds:
      if (!waits.bounds) waits.bounds_before = state.bounds_before;
      waits.bounds = true;
      return;
    default:
      waits.phase = needs_memory(state.last.order);
  }
}

void undo(const UnwrittenOrders& waits, Mission& mission, CarryOut& carrying) {
  if (waits.lease) mission.lease = waits.lease_before;
  if (waits.bounds) mission.bounds = waits.bounds_before;
  if (waits.phase && is_active(mission.phase))
    hold_mission(carrying, mission, MissionEnd::kUnwritten);
}

bool is_undone(const UnwrittenOrders& waits) {
  switch (waits.newest.order) {
    case MissionOrder::kLease:
      return waits.lease;
    case MissionOrder::kSetBounds:
      return waits.bounds;
    default:
      return waits.phase && needs_memory(waits.newest.order);
  }
}

}  // namespace

void take_order(OrderState& state, Mission& mission, CarryOut& carrying,
                const MissionCommand& command, const Moment& moment, const AutopilotStatus& status,
                const MissionRules& rules) {
  state.lease_before = mission.lease;
  state.bounds_before = mission.bounds;
  state.last = command;
  state.result = apply(command, mission, moment, rules);
  const bool about_phase = command.order != MissionOrder::kLease &&
                           command.order != MissionOrder::kRelease &&
                           command.order != MissionOrder::kSetBounds;
  if (state.result == MissionResult::kAccepted && about_phase)
    begin_phase(carrying, moment.now_s, status);
}

void await_writing(OrderState& state, const GateMemory& memory, bool is_news) {
  UnwrittenOrders& waits = state.unwritten;
  if (state.result != MissionResult::kAccepted || !(is_news || waits.any)) return;
  if (!waits.any) waits = {};
  if (is_news) note_what_to_undo(state, waits);
  waits.any = true;
  waits.newest = state.last;
  waits.revision = memory.revision;
  state.result = MissionResult::kPending;
}

void settle_order(OrderState& state, Mission& mission, CarryOut& carrying,
                  const MemoryWriting& writing) {
  UnwrittenOrders& waits = state.unwritten;
  if (!waits.any) return;
  const bool written = writing.written_revision >= waits.revision;
  if (!written && writing.failed_revision < waits.revision) return;
  waits.any = false;
  state.last = waits.newest;
  state.result = MissionResult::kAccepted;
  if (written) return;
  undo(waits, mission, carrying);
  state.result =
      is_undone(waits) ? MissionResult::kRefusedUnwritten : MissionResult::kAcceptedUnwritten;
}

}  // namespace foretrack
