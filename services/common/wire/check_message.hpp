// SPDX-License-Identifier: Apache-2.0
// Is this datagram an RTPS message that the library may read? Fast DDS 2.9 trusts lengths, counts
// and orders that anybody can send it, asserts them, and takes the process with it; here they are
// judged before it sees them. Values only: no DDS.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace foretrack::wire {

enum class Fault {
  kNone,
  kHeader,      // not RTPS 2
  kFrame,       // a submessage that does not fit
  kStatistics,  // eProsima's own submessage where it does not belong
  kSequence,    // sequence or fragment numbers, their sets and ranges
  kData,        // a sample's header or inline parameters
  kFragment,    // a piece of a sample that it cannot be
  kDiscovery,   // parameters of a participant or endpoint, signs of life, handshakes
  kSecurity,    // a protected submessage whose parts do not fit each other
  kStranger,    // a participant that shows no identity where each must have one
  kIdentity,    // an identity that was not accepted: refused by DDS-Security, not here
  kRole,        // a writer or reader that its identity may not have: the same
};
inline constexpr std::size_t kFaults = 12;
/// In words, for people: "a submessage's length".
const char* word(Fault fault);

/// Nobody of ours sends larger samples, and a first fragment makes the library set aside all of it.
inline constexpr std::uint32_t kLargestSample_B = 64u << 20;
/// A gap is walked number by number.
inline constexpr std::int64_t kLongestGap = 1 << 20;
/// The library keeps a list inside of the sample, an entry at the start of each fragment.
inline constexpr std::uint32_t kSmallestFragment_B = 64;

struct Checked {
  static constexpr std::size_t kMostBlanks = 64;

  Fault fault = Fault::kNone;
  /// So much of it is to be read: a statistics submessage at the end is left away.
  std::size_t size = 0;
  /// Where ids of parameters stand (two bytes each) that are to be blanked: what describes types
  /// and filters is parsed deeply, and nobody here needs it.
  std::array<std::uint32_t, kMostBlanks> blanks{};
  std::size_t blank_count = 0;
  /// A participant tells of itself, and has no identity of DDS-Security.
  bool of_stranger = false;
};

/// Work is bounded by the message's length.
Checked check_message(std::span<const std::uint8_t> message);

}  // namespace foretrack::wire
