// SPDX-License-Identifier: Apache-2.0
// MCAP's records (https://mcap.dev/spec): op codes, and how values are laid out in bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace foretrack::station::mcap {

using Bytes = std::vector<std::uint8_t>;

inline constexpr std::uint8_t kMagic[] = {0x89, 'M', 'C', 'A', 'P', 0x30, '\r', '\n'};

enum class Op : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

inline constexpr std::size_t kRecordHeadBytes = 9;  // op code and length

/// CRC-32 as in zlib; begin with 0 and pass on what it returned.
std::uint32_t crc32(std::uint32_t crc, std::span<const std::uint8_t> data);

/// Appends values, little endian, to bytes.
class Encoder {
 public:
  explicit Encoder(Bytes& out) : out_(out) {}

  void u8(std::uint8_t value) { out_.push_back(value); }
  void u16(std::uint16_t value) { number(value); }
  void u32(std::uint32_t value) { number(value); }
  void u64(std::uint64_t value) { number(value); }
  void bytes(std::span<const std::uint8_t> data) {
    out_.insert(out_.end(), data.begin(), data.end());
  }
  void string(std::string_view text);
  void strings(const std::map<std::string, std::string>& pairs);

  /// A record begins here; end() fills in its length.
  void begin(Op op);
  void end();

 private:
  template <class T>
  void number(T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i)
      out_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  }
  Bytes& out_;
  std::size_t length_at_ = 0;
};

/// Takes values off the front. What is not there reads as zero and empty, and good() is false.
class Decoder {
 public:
  explicit Decoder(std::span<const std::uint8_t> data) : data_(data) {}

  std::uint8_t u8() { return number<std::uint8_t>(); }
  std::uint16_t u16() { return number<std::uint16_t>(); }
  std::uint32_t u32() { return number<std::uint32_t>(); }
  std::uint64_t u64() { return number<std::uint64_t>(); }
  std::span<const std::uint8_t> bytes(std::uint64_t size);
  std::span<const std::uint8_t> rest() { return bytes(data_.size()); }
  std::string string();
  std::map<std::string, std::string> strings();
  bool good() const { return good_; }
  bool empty() const { return data_.empty(); }

 private:
  template <class T>
  T number() {
    T value = 0;
    const auto from = bytes(sizeof(T));
    for (std::size_t i = 0; i < from.size(); ++i)
      value = static_cast<T>(value | static_cast<T>(static_cast<T>(from[i]) << (8 * i)));
    return value;
  }
  std::span<const std::uint8_t> data_;
  bool good_ = true;
};

}  // namespace foretrack::station::mcap
