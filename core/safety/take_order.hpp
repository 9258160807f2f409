// SPDX-License-Identifier: Apache-2.0
// Taking an order: it acts at once, is written outside of the loop, and only then confirmed.
#pragma once

#include "core/safety/carry_out.hpp"
#include "core/safety/memory.hpp"

namespace foretrack {

/// How far the memory is written, as its writer says. By default, nothing is to be written.
struct MemoryWriting {
  std::uint64_t written_revision = ~std::uint64_t{0};  // this one and all before
  std::uint64_t failed_revision = 0;                   // the newest that could not be
};

/// What acts already and is not yet written: one order, or several that came in a row.
struct UnwrittenOrders {
  bool any = false;
  MissionCommand newest;
  std::uint64_t revision = 0;  // of the memory with all of them
  // What must be undone if they cannot be written, and to what.
  bool phase = false, lease = false, bounds = false;
  MissionLease lease_before;
  FlightBounds bounds_before;
};

/// The last order that was answered, and those that wait. An answer does not forget what waits: an
/// order that is refused meanwhile is answered at once, and the one that waits when it is settled.
struct OrderState {
  MissionCommand last;
  MissionResult result = MissionResult::kNone;
  MissionLease lease_before;  // the last order
  FlightBounds bounds_before;
  UnwrittenOrders unwritten;
};

/// Judges and applies the command.
void take_order(OrderState& state, Mission& mission, CarryOut& carrying,
                const MissionCommand& command, const Moment& moment, const AutopilotStatus& status,
                const MissionRules& rules);

/// After the memory was updated with the order: it waits to be written, if it is news, or if what
/// it repeats waits.
void await_writing(OrderState& state, const GateMemory& memory, bool is_news);

/// Confirms what waits, or undoes all of it. Stop, hold, return, land and release stand in any
/// case.
void settle_order(OrderState& state, Mission& mission, CarryOut& carrying,
                  const MemoryWriting& writing);

}  // namespace foretrack
