// SPDX-License-Identifier: Apache-2.0
// RTPS messages, byte by byte.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace foretrack::testing {

using Bytes = std::vector<std::uint8_t>;

/// Little-endian, as its flags say.
class Datagram {
 public:
  explicit Datagram(std::uint8_t vendor = 0x0f, std::uint8_t major = 2) {
    bytes = {'R', 'T', 'P', 'S', major, 3, 1, vendor};
    for (std::uint8_t i = 0; i < 12; ++i) bytes.push_back(static_cast<std::uint8_t>(0xa0 + i));
  }
  Datagram& submessage(std::uint8_t id, const Bytes& content, std::uint8_t flags = 1) {
    header(id, flags, static_cast<std::uint16_t>(content.size()));
    bytes.insert(bytes.end(), content.begin(), content.end());
    return *this;
  }
  Datagram& header(std::uint8_t id, std::uint8_t flags, std::uint16_t length) {
    bytes.insert(bytes.end(), {id, flags, static_cast<std::uint8_t>(length),
                               static_cast<std::uint8_t>(length >> 8)});
    return *this;
  }

  Bytes bytes;
};

/// Numbers, one behind the other.
class Content {
 public:
  Content& u16(std::uint32_t value) { return number(value, 2); }
  Content& u32(std::uint64_t value) { return number(value, 4); }
  Content& sequence_number(std::int64_t value) {
    const auto bits = static_cast<std::uint64_t>(value);
    return u32(bits >> 32).u32(bits & 0xffffffffu);
  }
  Content& big_u32(std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
      bytes.push_back(static_cast<std::uint8_t>(value >> shift));
    return *this;
  }
  Content& zeros(std::size_t count) {
    bytes.insert(bytes.end(), count, 0);
    return *this;
  }
  Content& text(const std::string& value) {
    u32(value.size() + 1);
    bytes.insert(bytes.end(), value.begin(), value.end());
    return zeros(1).align();
  }
  Content& align() { return zeros((4 - bytes.size() % 4) % 4); }
  Content& parameter(std::uint16_t id, const Bytes& value) {
    u16(id).u16(static_cast<std::uint32_t>(value.size()));
    bytes.insert(bytes.end(), value.begin(), value.end());
    return align();
  }
  Content& sentinel() { return u16(1).u16(0); }
  Content& append(const Bytes& more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
    return *this;
  }

  Bytes bytes;

 private:
  Content& number(std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    return *this;
  }
};

inline constexpr std::uint32_t kUserWriter = 0x00001203, kUserReader = 0x00001304;
inline constexpr std::uint32_t kParticipantWriter = 0x000100c2, kParticipantReader = 0x000100c7;

/// What stands before the inline parameters or the payload of a sample.
inline Content sample(std::uint32_t writer = kUserWriter, std::uint32_t reader = kUserReader,
                      std::int64_t number = 1, std::uint16_t to_inline = 16) {
  Content result;
  return result.u16(0).u16(to_inline).big_u32(reader).big_u32(writer).sequence_number(number);
}

inline constexpr std::uint8_t kLittle = 1, kInline = 2, kWithData = 4, kWithKey = 8;

/// A participant that announces itself by parameters.
inline Datagram announcement(const Bytes& parameters) {
  Content content = sample(kParticipantWriter, kParticipantReader);
  content.append({0, 3, 0, 0}).append(parameters);
  return Datagram().submessage(0x15, content.bytes, kLittle | kWithData);
}

}  // namespace foretrack::testing
