// SPDX-License-Identifier: Apache-2.0
// Pictures from files, videos and cameras.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/common/image.hpp"

namespace foretrack {

struct Frame {
  double stamp_s = 0.0;  // pictures: 0; videos: from their start; cameras: since they were opened
  std::string file;      // of pictures
  RgbImage image;
};

/// Frames one after another.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// None: there are no more. Throws std::runtime_error that names the file or device and the
  /// trouble.
  virtual std::optional<Frame> next() = 0;
  /// Frames in all; 0: unknown.
  virtual int count() const { return 0; }
  /// Frames a second, as the source says; 0: unknown.
  virtual double rate_hz() const { return 0.0; }
};

std::unique_ptr<FrameSource> open_pictures(std::vector<std::string> files);
std::unique_ptr<FrameSource> open_video(const std::string& file);
/// A device ("/dev/video0") or its number ("0").
std::unique_ptr<FrameSource> open_camera(const std::string& device);

/// Throws std::runtime_error that names the file: missing, empty, not a picture, or too big.
RgbImage load_picture(const std::string& file);

}  // namespace foretrack
