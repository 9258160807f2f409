// SPDX-License-Identifier: Apache-2.0
// Pictures out of the loop's way: a thread of its own scales and encodes them.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/common/image.hpp"
#include "services/convert/encode_h264.hpp"

namespace foretrack {

/// Of what a picture was, and how it shall be.
struct PictureLabel {
  double stamp_s = 0.0;
  std::string frame_id;
  int width_px = 0;
  std::optional<int> jpeg_quality = {};  ///< none: not as JPEG
  std::optional<VideoWish> video = {};   ///< none: not as a picture of the video
};

struct EncodedPicture {
  PictureLabel label;
  int width_px = 0;  ///< that it came to
  int height_px = 0;
  std::vector<std::uint8_t> jpeg;   ///< empty: was not asked for, or cannot be
  std::vector<std::uint8_t> video;  ///< the same
};

/// One picture waits to be encoded; a newer one takes its place. Once it is encoded it waits to be
/// taken, and none else is begun before: a video lacks none of its pictures. The caller never waits
/// for the encoder. Buffers are used again and again.
class PictureEncoder {
 public:
  PictureEncoder();
  ~PictureEncoder();
  PictureEncoder(const PictureEncoder&) = delete;
  PictureEncoder& operator=(const PictureEncoder&) = delete;

  /// Copies the image.
  void give(const RgbImage& image, const PictureLabel& label);
  /// What is done and was not taken yet, into `out`; false: there is none.
  bool take(EncodedPicture& out);

 private:
  struct Picture {
    RgbImage image;
    PictureLabel label;
  };
  void run();
  void encode(const Picture& picture, EncodedPicture& out);

  RgbImage shrunk_;    // the thread's own
  H264Encoder video_;  // likewise
  std::mutex mutex_;   // guards what follows, but for the thread
  std::condition_variable changed_;
  Picture waits_;
  EncodedPicture done_;
  bool has_waiting_ = false, has_done_ = false, ends_ = false;
  std::thread thread_;
};

}  // namespace foretrack
