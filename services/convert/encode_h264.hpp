// SPDX-License-Identifier: Apache-2.0
// Video out, as H.264.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/common/image.hpp"

namespace foretrack {

/// Whether this was built with OpenH264. Without it nothing is encoded.
bool has_video_encoder();

/// How a picture of a video shall be.
struct VideoWish {
  double stamp_s = 0.0;
  double bandwidth_kbit_s = 0.0;
  double rate_hz = 0.0;  ///< of the pictures, at most
  int readers = 0;       ///< when there are more, one of them has seen nothing yet
};

/// Constrained baseline, without delay: each picture comes out at once and leans on the one before.
/// A key picture, with its parameter sets before it, begins anew: the first, at least one a second
/// by the stamps, and when there are more readers.
class H264Encoder {
 public:
  H264Encoder();
  ~H264Encoder();

  /// One picture as Annex B. `out` keeps its memory; it is empty if the picture cannot be encoded
  /// (a side below 16 px, or more than level 5.2 has). Each that comes out must reach the readers,
  /// in turn. Of an odd width or height the last column or row is left out. Cost: bench/README.md.
  void encode(const RgbImage& image, const VideoWish& wish, std::vector<std::uint8_t>& out);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretrack
