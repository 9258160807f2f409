// SPDX-License-Identifier: Apache-2.0
// Taking an order: it acts at once, is written outside of the loop, and only then confirmed.
#pragma once

#include <array>

#include "core/safety/carry_out.hpp"
#include "core/safety/memory.hpp"

namespace foretrack {

/// How far the memory is written, as its writer says. By default, nothing is to be written.
struct MemoryWriting {
  std::uint64_t written_revision = ~std::uint64_t{0};  // this one and all before
  std::uint64_t failed_revision = 0;                   // the newest that could not be
};

/// An order that acts already, and what is to be answered.
struct UnwrittenOrder {
  MissionCommand command;
  MissionResult result = MissionResult::kPending;  // until it is decided
};

/// The orders that act already and are being written, or are to be answered. Oldest first; those
/// that are decided come before the others.
struct UnwrittenOrders {
  static constexpr int kCapacity = 8;  // of more, the oldest is never answered

  std::array<UnwrittenOrder, kCapacity> orders;
  int count = 0, decided = 0;
  std::uint64_t revision = 0;  // of the memory with all of them
  // What must be undone if they cannot be written, and to what.
  bool phase = false, lease = false, bounds = false, person = false, framing = false;
  Mission before;

  bool any_is_being_written() const { return decided < count; }
};

/// The order that was answered last, and those that wait. An answer does not forget what waits.
struct OrderState {
  MissionCommand last;
  MissionResult result = MissionResult::kNone;
  Mission before;  // the last order that came
  UnwrittenOrders unwritten;
};

/// Judges and applies the command. `bodies`: as in apply().
void take_order(OrderState& state, Mission& mission, CarryOut& carrying,
                const MissionCommand& command, const Moment& moment, const AutopilotStatus& status,
                const MissionRules& rules, const MovingBodies* bodies = nullptr);

/// After the memory was updated with the order: it waits to be written, if it is news, or if what
/// it repeats waits.
void await_writing(OrderState& state, const GateMemory& memory, bool is_news);

/// Confirms what was written, or undoes all that waited for it. Stop, hold, return, land and
/// release stand in any case.
void settle_orders(OrderState& state, Mission& mission, CarryOut& carrying,
                   const MemoryWriting& writing);

/// Makes the oldest of those that are decided the last that was answered. One at a time, so that
/// each is told.
void answer_order(OrderState& state);

}  // namespace foretrack
