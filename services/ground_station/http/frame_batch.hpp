// SPDX-License-Identifier: Apache-2.0
// Frames of the hub as WebSocket frames (RFC 6455, section 5.2), several in one gathered write.
#pragma once

#include <array>
#include <vector>

#include "services/ground_station/http/beast.hpp"
#include "services/ground_station/hub/outbox.hpp"

namespace foretrack::station {

/// Of a frame that a server sends: whole, not masked. Returns the header's bytes.
inline std::size_t write_frame_header(std::uint8_t* to, bool text, std::uint64_t payload_bytes) {
  constexpr std::uint8_t kWhole = 0x80, kText = 1, kBinary = 2;
  to[0] = kWhole | (text ? kText : kBinary);
  const std::size_t length_bytes = payload_bytes < 126 ? 0 : payload_bytes < 65536 ? 2 : 8;
  to[1] = static_cast<std::uint8_t>(length_bytes == 0   ? payload_bytes
                                    : length_bytes == 2 ? 126
                                                        : 127);
  for (std::size_t i = 0; i < length_bytes; ++i)
    to[2 + i] = static_cast<std::uint8_t>(payload_bytes >> (8 * (length_bytes - 1 - i)));
  return 2 + length_bytes;
}

/// Keeps what a write in progress reads. Samples are not copied: all clients share them.
class FrameBatch {
 public:
  static constexpr std::size_t kFrames = 32;        // two pieces each: as many as one call gathers
  static constexpr std::size_t kBytes = 16 * 1024;  // what is taken here no longer gives way

  void clear() {
    frames_.clear();
    buffers_.clear();
    bytes_ = 0;
  }
  bool empty() const { return frames_.empty(); }
  bool full() const { return frames_.size() >= kFrames || bytes_ >= kBytes; }

  void add(Frame frame) {
    bytes_ += frame.bytes();
    frames_.push_back(std::move(frame));
    const Frame& f = frames_.back();
    auto& head = heads_[frames_.size() - 1];
    auto size = write_frame_header(head.data(), f.text != nullptr, f.bytes());
    if (!f.text) {
      std::copy(f.header.begin(), f.header.end(), head.begin() + size);
      size += f.header.size();
    }
    buffers_.push_back(asio::buffer(head.data(), size));
    buffers_.push_back(f.text ? asio::buffer(*f.text) : asio::buffer(*f.data));
  }
  const std::vector<asio::const_buffer>& buffers() const { return buffers_; }

 private:
  static constexpr std::size_t kHeadBytes = 10 + foxglove::kMessageHeaderBytes;
  std::array<std::array<std::uint8_t, kHeadBytes>, kFrames> heads_;
  std::vector<Frame> frames_;
  std::vector<asio::const_buffer> buffers_;
  std::size_t bytes_ = 0;
};

}  // namespace foretrack::station
