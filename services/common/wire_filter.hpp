// SPDX-License-Identifier: Apache-2.0
// What a participant refused to read, by reason: counted, and logged now and then.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "services/common/wire/check_message.hpp"

namespace foretrack {

/// Of one participant. All of it from any thread; the transports' threads call judge().
class WireFilter {
 public:
  using Counts = std::vector<std::pair<std::string, std::uint64_t>>;

  /// `report` gets a line for people, at most one in ten seconds.
  explicit WireFilter(std::function<void(const std::string&)> report)
      : report_(std::move(report)) {}

  /// From now on, who shows no identity is refused.
  void demand_identity() { demands_identity_ = true; }

  struct Verdict {
    wire::Fault fault = wire::Fault::kNone;
    /// What the library may read; lives until the thread's next call.
    std::span<const std::uint8_t> message;
  };
  Verdict judge(std::span<const std::uint8_t> message);
  /// Counts what was judged so, here or by DDS-Security, and who sent it.
  void refuse(wire::Fault fault, const std::string& from);
  /// From another machine, where only this one is to be heard.
  void refuse_outsider() { ++outsiders_; }

  std::uint64_t accepted() const { return accepted_; }
  std::uint64_t refused() const;
  std::uint64_t outsiders() const { return outsiders_; }
  /// Those that are not 0.
  Counts refused_by_reason() const;

 private:
  std::function<void(const std::string&)> report_;
  std::atomic<bool> demands_identity_ = false;
  std::atomic<std::uint64_t> accepted_ = 0, outsiders_ = 0;
  std::array<std::atomic<std::uint64_t>, wire::kFaults> refused_{};
  std::mutex report_mutex_;
  double next_report_s_ = 0.0;
};

}  // namespace foretrack
