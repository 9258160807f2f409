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

/// What is known of the last order, and what it may have to be undone to.
struct OrderState {
  MissionCommand last;
  MissionResult result = MissionResult::kNone;
  std::uint64_t revision = 0;  // while pending: of the memory with it
  Mission before;
};

/// Judges and applies the command.
void take_order(OrderState& state, Mission& mission, CarryOut& carrying,
                const MissionCommand& command, const Moment& moment, const AutopilotStatus& status,
                const MissionRules& rules);

/// After the memory was updated with the order: it waits to be written, if it is news.
void await_writing(OrderState& state, const GateMemory& memory, bool is_news);

/// Confirms what waits, or undoes it. Stop, hold, return, land and release stand in any case.
void settle_order(OrderState& state, Mission& mission, CarryOut& carrying,
                  const MemoryWriting& writing);

}  // namespace foretrack
