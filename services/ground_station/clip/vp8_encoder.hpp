// SPDX-License-Identifier: Apache-2.0
// Video for files that browsers play, by libvpx.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "services/convert/i420.hpp"

namespace foretrack::station {

/// One picture after the other, each at its own time.
class Vp8Encoder {
 public:
  struct Encoded {
    std::span<const std::uint8_t> bytes;  // valid until the next one
    bool key = false;
  };
  /// Throws std::runtime_error if libvpx refuses this size, or was not there when this was built.
  Vp8Encoder(int width_px, int height_px);
  ~Vp8Encoder();

  /// Of the encoder's size, and later than the one before. A key picture comes first, and when the
  /// last one is 2 s old. Throws std::runtime_error if libvpx fails.
  Encoded encode(I420Image& picture, std::int64_t time_ms);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretrack::station
