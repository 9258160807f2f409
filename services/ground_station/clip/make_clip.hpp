// SPDX-License-Identifier: Apache-2.0
// The ground's pictures of a recording as a video.
#pragma once

#include <filesystem>
#include <limits>
#include <string>

namespace foretrack::station {

constexpr double kLongestClip_s = 600.0;

struct ClipWish {
  std::string vehicle;  // empty: the only one there is
  double from_s = 0.0;  // by the time of the recording, from its beginning
  double to_s = std::numeric_limits<double>::infinity();
};

struct Clip {
  std::string vehicle;
  std::string webm;  // the file
  int pictures = 0;
  int left_out = 0;  // broken ones, those of another size than the first, and doubles
  double seconds = 0.0;
};

/// Pictures follow each other as their stamps do. Throws std::runtime_error that says what is
/// wrong: the file is no recording, there is no such vehicle, no picture in that span, or more than
/// kLongestClip_s.
Clip make_clip(const std::filesystem::path& recording, const ClipWish& wish);

}  // namespace foretrack::station
