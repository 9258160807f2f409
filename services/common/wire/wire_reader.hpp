// SPDX-License-Identifier: Apache-2.0
// Numbers out of bytes that anybody may have sent. What is not there reads as 0, and ok() is false.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace foretrack::wire {

class Reader {
 public:
  Reader(std::span<const std::uint8_t> bytes, bool little_endian)
      : bytes_(bytes), little_(little_endian) {}

  bool ok() const { return ok_; }
  bool little_endian() const { return little_; }
  std::size_t position() const { return at_; }
  std::size_t left() const { return bytes_.size() - at_; }
  std::span<const std::uint8_t> rest() const { return bytes_.subspan(at_); }

  std::uint16_t u16() { return static_cast<std::uint16_t>(number(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(number(4)); }
  /// Four bytes as they are written, first one highest: an entity's id.
  std::uint32_t id() {
    const bool little = little_;
    little_ = false;
    const std::uint32_t result = u32();
    little_ = little;
    return result;
  }
  /// A sequence number: its high half comes first, in either byte order.
  std::int64_t sequence_number() {
    const std::uint64_t high = u32(), low = u32();
    return static_cast<std::int64_t>((high << 32) | low);
  }
  std::span<const std::uint8_t> take(std::size_t count) {
    if (count > left()) return fail();
    at_ += count;
    return bytes_.subspan(at_ - count, count);
  }
  void skip(std::size_t count) { take(count); }
  /// To the next multiple of four from the beginning; the end counts as one.
  void align() {
    const std::size_t aligned = (at_ + 3) / 4 * 4;
    at_ = aligned < bytes_.size() ? aligned : bytes_.size();
  }

 private:
  std::uint64_t number(std::size_t count) {
    const auto from = take(count);
    std::uint64_t result = 0;
    for (std::size_t i = 0; i < from.size(); ++i)
      result = (result << 8) | from[little_ ? from.size() - 1 - i : i];
    return result;
  }
  std::span<const std::uint8_t> fail() {
    ok_ = false;
    at_ = bytes_.size();
    return {};
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  bool little_;
  bool ok_ = true;
};

}  // namespace foretrack::wire
