// SPDX-License-Identifier: Apache-2.0
// Annotated pictures and videos.
#pragma once

#include <memory>
#include <string>

#include "core/common/image.hpp"
#include "core/perception/find_landmarks.hpp"

namespace foretrack {

/// Draws the skeleton, one line of text beside the person, and the region that was looked at.
void draw_person(RgbImage& image, const PersonPose& person, const std::string& text);

class FrameSink {
 public:
  virtual ~FrameSink() = default;
  virtual void write(const RgbImage& image) = 0;
};

/// One picture (.png, .jpg) or a video (.mp4, .avi, .mkv) by the file's ending. Throws
/// std::invalid_argument for other endings, std::runtime_error if it cannot be written.
std::unique_ptr<FrameSink> open_sink(const std::string& file, double rate_hz);

/// True if the ending is that of a video.
bool is_video_name(const std::string& file);

}  // namespace foretrack
