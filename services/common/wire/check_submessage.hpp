// SPDX-License-Identifier: Apache-2.0
// One submessage, whose frame is already known to fit.
#pragma once

#include <cstdint>
#include <span>

#include "services/common/wire/check_message.hpp"

namespace foretrack::wire {

/// Of RTPS 2.5 (table 8.13) and DDS-Security 1.1 (7.3.6); from 0x80 on they are vendors' own.
enum : std::uint8_t {
  kNone = 0x00,  // nobody's; where one is signed, the library takes it for a length
  kPad = 0x01,
  kAckNack = 0x06,
  kHeartbeat = 0x07,
  kGap = 0x08,
  kInfoTimestamp = 0x09,
  kInfoSource = 0x0c,
  kInfoDestination = 0x0e,
  kNackFragments = 0x12,
  kHeartbeatFragments = 0x13,
  kData = 0x15,
  kDataFragments = 0x16,
  kSecureBody = 0x30,
  kSecurePrefix = 0x31,
  kSecurePostfix = 0x32,
  kSecureMessagePrefix = 0x33,
  kSecureMessagePostfix = 0x34,
  kStatistics = 0x80,
};

struct Submessage {
  std::uint8_t id = 0;
  std::uint8_t flags = 0;
  std::uint32_t position = 0;  // of its content in the message
  std::span<const std::uint8_t> content;

  bool little_endian() const { return (flags & 1) != 0; }
  bool has(int flag) const { return (flags >> flag & 1) != 0; }
};

/// Adds what is to be blanked. Ids that the library does not read are fine.
Fault check_submessage(const Submessage& submessage, Checked& checked);

}  // namespace foretrack::wire
