// SPDX-License-Identifier: Apache-2.0
#include "services/common/wire/heartbeat_watch.hpp"

#include <algorithm>

#include "services/common/wire/check_submessage.hpp"
#include "services/common/wire/wire_reader.hpp"

namespace foretrack::wire {
namespace {

constexpr std::size_t kHeader = 20, kFrame = 4, kPrefixAt = 8, kPrefix = 12;
constexpr std::size_t kWriterAt = 4, kFirstAt = 8;  // in a heartbeat

}  // namespace

bool HeartbeatWatch::accepts(std::span<const std::uint8_t> message, double now_s) {
  Writer writer{};
  std::copy_n(message.begin() + kPrefixAt, kPrefix, writer.begin());
  for (std::size_t at = kHeader; at + kFrame <= message.size();) {
    const bool little = (message[at + 1] & 1) != 0;
    Reader header(message.subspan(at + 2), little);
    const std::size_t length = header.u16();
    const auto content = message.subspan(at + kFrame);
    // Another sender's, from here on.
    if (message[at] == kInfoSource)
      std::copy_n(content.begin() + kPrefixAt, kPrefix, writer.begin());
    if (message[at] == kHeartbeat) {
      std::copy_n(content.begin() + kWriterAt, 4, writer.begin() + kPrefix);
      Reader reader(content.subspan(kFirstAt), little);
      if (!accepts(writer, reader.sequence_number(), now_s)) return false;
    }
    if (length == 0 && message[at] != kPad && message[at] != kInfoTimestamp) break;
    at += kFrame + (length + 3) / 4 * 4;
  }
  return true;
}

bool HeartbeatWatch::accepts(const Writer& writer, std::int64_t first, double now_s) {
  const std::lock_guard lock(mutex_);
  const auto it = heard_.find(writer);
  if (it == heard_.end()) {
    if (first > kLongestPast) return false;
    if (heard_.size() >= kMostWriters) heard_.clear();
    heard_[writer] = {first, now_s};
    return true;
  }
  auto& heard = it->second;
  const double most = static_cast<double>(heard.first + kLongestLeap) +
                      kMostNumbers_1_s * std::max(0.0, now_s - heard.at_s);
  if (static_cast<double>(first) > most) return false;
  heard = {std::max(heard.first, first), now_s};
  return true;
}

}  // namespace foretrack::wire
