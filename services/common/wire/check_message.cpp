// SPDX-License-Identifier: Apache-2.0
#include "services/common/wire/check_message.hpp"

#include <algorithm>

#include "services/common/wire/check_submessage.hpp"

namespace foretrack::wire {
namespace {

constexpr std::size_t kHeader = 20, kFrame = 4;
constexpr std::uint8_t kMagic[] = {'R', 'T', 'P', 'S', 2};
constexpr std::size_t kStatisticsContent = 56;

bool has_header(std::span<const std::uint8_t> message) {
  return message.size() >= kHeader &&
         std::equal(std::begin(kMagic), std::end(kMagic), message.begin());
}

bool is_from_eprosima(std::span<const std::uint8_t> message) {
  return message[6] == 0x01 && message[7] == 0x0f;
}

/// The submessage at a position, and where the next one begins.
struct Frame {
  bool fits = false;
  Submessage submessage;
  std::size_t next = 0;
};

Frame frame_at(std::span<const std::uint8_t> message, std::size_t at) {
  Frame frame;
  if (message.size() - at < kFrame) return frame;
  auto& s = frame.submessage;
  s.id = message[at];
  s.flags = message[at + 1];
  s.position = static_cast<std::uint32_t>(at + kFrame);
  std::size_t length = s.little_endian() ? message[at + 2] | message[at + 3] << 8
                                         : message[at + 2] << 8 | message[at + 3];
  const std::size_t left = message.size() - at - kFrame;
  // Zero: up to the end of the message. Not for those that may be empty.
  if (length == 0 && s.id != kPad && s.id != kInfoTimestamp) length = left;
  if (length > left) return frame;
  frame.fits = true;
  s.content = message.subspan(at + kFrame, length);
  frame.next = std::min(at + kFrame + (length + 3) / 4 * 4, message.size());
  return frame;
}

/// Parts of what is protected stand in one order: prefix, one submessage, postfix; or, around the
/// whole message, the same with any number between.
class Protection {
 public:
  bool accepts(std::uint8_t id, bool first, bool last) {
    if (after_ && id != kSecurePostfix) return false;  // what follows the protected one
    if (id == kSecureBody && !open_ && !whole_) return false;
    const bool protected_one = open_;
    if (id == kSecurePostfix && !after_) return false;
    if (id == kSecureMessagePostfix && (!whole_ || !last)) return false;
    if (id == kSecureMessagePrefix && !first) return false;
    if (protected_one && id == kSecurePrefix) return false;
    after_ = protected_one;
    open_ = id == kSecurePrefix;
    if (id == kSecureMessagePrefix) whole_ = true;
    closed_ = closed_ || id == kSecureMessagePostfix;
    return true;
  }
  bool complete() const { return !open_ && !after_ && whole_ == closed_; }

 private:
  bool open_ = false, after_ = false;    // behind a prefix; behind what it protects
  bool whole_ = false, closed_ = false;  // the message's own prefix and postfix
};

}  // namespace

const char* word(Fault fault) {
  constexpr const char* kWords[kFaults] = {"nothing",
                                           "not RTPS 2",
                                           "a submessage's length",
                                           "misplaced statistics",
                                           "sequence numbers",
                                           "a sample's header",
                                           "a sample's fragments",
                                           "discovery's parameters",
                                           "parts of what is protected",
                                           "a participant without an identity",
                                           "an identity that is not accepted",
                                           "a writer or reader that its role may not have"};
  return kWords[static_cast<std::size_t>(fault)];
}

namespace {

// The end of what is to be read: before a statistics submessage, which may only stand at the end.
Fault cut_statistics(std::span<const std::uint8_t> message, Checked& checked) {
  for (std::size_t at = kHeader; at < message.size();) {
    const Frame frame = frame_at(message, at);
    if (!frame.fits) return Fault::kFrame;
    if (frame.submessage.id == wire::kStatistics) {
      const bool at_the_end = frame.next == message.size();
      if (frame.submessage.content.size() != kStatisticsContent || !at_the_end)
        return Fault::kStatistics;
      checked.size = at;
    }
    at = frame.next;
  }
  return Fault::kNone;
}

Fault check_submessages(std::span<const std::uint8_t> message, Checked& checked) {
  Protection protection;
  for (std::size_t at = kHeader; at < message.size();) {
    const Frame frame = frame_at(message, at);
    if (!frame.fits) return Fault::kFrame;
    const bool first = at == kHeader, last = frame.next == message.size();
    if (!protection.accepts(frame.submessage.id, first, last)) return Fault::kSecurity;
    if (const Fault fault = check_submessage(frame.submessage, checked); fault != Fault::kNone)
      return fault;
    at = frame.next;
  }
  return protection.complete() ? Fault::kNone : Fault::kSecurity;
}

}  // namespace

Checked check_message(std::span<const std::uint8_t> message) {
  Checked checked;
  checked.size = message.size();
  checked.fault = has_header(message) ? Fault::kNone : Fault::kHeader;
  if (checked.fault == Fault::kNone && is_from_eprosima(message))
    checked.fault = cut_statistics(message, checked);
  if (checked.fault == Fault::kNone)
    checked.fault = check_submessages(message.first(checked.size), checked);
  return checked;
}

}  // namespace foretrack::wire
