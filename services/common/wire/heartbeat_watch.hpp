// SPDX-License-Identifier: Apache-2.0
// Heartbeats that leap. The library steps over each sequence number that a heartbeat says is no
// longer kept, so that one heartbeat can keep a reader busy for years, deaf to everybody.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <span>

namespace foretrack::wire {

/// What a writer may have written before it was heard for the first time: 50 Hz for four days, and
/// some seconds of stepping.
inline constexpr std::int64_t kLongestPast = 1 << 24;
/// How far it may go from one heartbeat to the next, at once and in a second.
inline constexpr std::int64_t kLongestLeap = 1 << 16;
inline constexpr double kMostNumbers_1_s = 1e4;

class HeartbeatWatch {
 public:
  /// Of a message that check_message() found good: whether no heartbeat in it leaps. From any
  /// thread.
  bool accepts(std::span<const std::uint8_t> message, double now_s);

 private:
  using Writer = std::array<std::uint8_t, 16>;
  struct Heard {
    std::int64_t first = 0;
    double at_s = 0.0;
  };
  bool accepts(const Writer& writer, std::int64_t first, double now_s);

  static constexpr std::size_t kMostWriters = 4096;
  std::mutex mutex_;
  std::map<Writer, Heard> heard_;
};

}  // namespace foretrack::wire
