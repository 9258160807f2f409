// SPDX-License-Identifier: Apache-2.0
// Bad messages against a living process, for a time.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tests/fuzz/bus/datagrams.hpp"

namespace foretrack::testing {

struct AttackOptions {
  double seconds = 15.0;
  std::uint64_t seed = 1;
  bool filtered = true;              // else the victim reads whatever comes
  std::vector<std::string> program;  // that is attacked, but for its domain; empty: our own victim
  std::string keys;                  // of enclaves vehicle and operator; empty: without security
  double hold_s = 0.0;               // a victim that hears nobody, for a debugger
  std::string record;                // folder for what was sent last, if the victim ends
};

struct AttackResult {
  std::uint64_t sent = 0, let_through = 0;  // of those sent, what the filter takes for good
  std::size_t seeds = 0;
  bool ended = false;      // the victim
  bool hears = false;      // it speaks with a newcomer afterwards
  double memory_MB = 0.0;  // the victim's, at the end
  std::string how;         // it ended
};

/// Throws std::runtime_error if the victim does not even begin.
AttackResult attack(const AttackOptions& options);

/// Sends one message to every port of the first participant in a new domain; how it ended, or
/// empty.
std::string send_one(const Message& message, const AttackOptions& options);

}  // namespace foretrack::testing
