// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/perception/picture_encoder.hpp"

#include <utility>

#include "core/perception/shrink_image.hpp"
#include "services/convert/encode_jpeg.hpp"

namespace foretrack {

PictureEncoder::PictureEncoder() : thread_([this] { run(); }) {}

PictureEncoder::~PictureEncoder() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void PictureEncoder::give(const RgbImage& image, const PictureLabel& label) {
  {
    const std::lock_guard lock(mutex_);  // held elsewhere for swaps alone
    waits_.image = image;
    waits_.label = label;
    has_waiting_ = true;
  }
  changed_.notify_one();
}

bool PictureEncoder::take(EncodedPicture& out) {
  const std::lock_guard lock(mutex_);
  if (!std::exchange(has_done_, false)) return false;
  std::swap(out, done_);
  return true;
}

void PictureEncoder::run() {
  Picture picture;
  RgbImage shrunk;
  EncodedPicture encoded;
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return has_waiting_ || ends_; });
    if (ends_) return;
    std::swap(picture, waits_);
    has_waiting_ = false;
    lock.unlock();
    shrink(picture.image, picture.label.width_px, shrunk);
    encode_jpeg(shrunk, picture.label.quality, encoded.jpeg);
    encoded.label = picture.label;
    encoded.width_px = shrunk.width_px;
    encoded.height_px = shrunk.height_px;
    lock.lock();
    if (encoded.jpeg.empty()) continue;
    std::swap(encoded, done_);
    has_done_ = true;
  }
}

}  // namespace foretrack
