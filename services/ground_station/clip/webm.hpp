// SPDX-License-Identifier: Apache-2.0
// A WebM file of one VP8 video, as browsers and VLC play and seek it. (Debian's libwebm has no
// headers for writing.)
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace foretrack::station {

class WebmWriter {
 public:
  WebmWriter(int width_px, int height_px) : width_px_(width_px), height_px_(height_px) {}

  /// Pictures in their order; `time_ms` from the video's beginning. The first is a key picture, and
  /// so is at least one of each 30 s.
  void add(std::int64_t time_ms, bool key, std::span<const std::uint8_t> vp8);

  /// The whole file; the last picture is shown for `last_ms`.
  std::string finish(std::int64_t last_ms) const;

 private:
  struct Cluster {
    std::int64_t time_ms = 0;
    std::string blocks;
  };
  int width_px_, height_px_;
  std::int64_t end_ms_ = 0;        // of the last picture's stamp
  std::vector<Cluster> clusters_;  // each begins with a key picture
};

}  // namespace foretrack::station
