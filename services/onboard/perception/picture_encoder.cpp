// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/perception/picture_encoder.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <utility>

#include "core/perception/shrink_image.hpp"
#include "services/convert/encode_jpeg.hpp"

namespace foretrack {
namespace {

constexpr int kNicer = 5;  // where both want the processor, the loop goes first

}  // namespace

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
  {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(has_done_, false)) return false;
    std::swap(out, done_);
  }
  changed_.notify_one();
  return true;
}

void PictureEncoder::run() {
  const auto thread = static_cast<id_t>(gettid());
  setpriority(PRIO_PROCESS, thread, getpriority(PRIO_PROCESS, thread) + kNicer);
  Picture picture;
  EncodedPicture encoded;
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return (has_waiting_ && !has_done_) || ends_; });
    if (ends_) return;
    std::swap(picture, waits_);
    has_waiting_ = false;
    lock.unlock();
    encode(picture, encoded);
    lock.lock();
    if (encoded.jpeg.empty() && encoded.video.empty()) continue;
    std::swap(encoded, done_);
    has_done_ = true;
  }
}

void PictureEncoder::encode(const Picture& picture, EncodedPicture& out) {
  const PictureLabel& label = picture.label;
  shrink(picture.image, label.width_px, shrunk_);
  out.label = label;
  out.width_px = shrunk_.width_px;
  out.height_px = shrunk_.height_px;
  out.jpeg.clear();
  out.video.clear();
  if (label.jpeg_quality) encode_jpeg(shrunk_, *label.jpeg_quality, out.jpeg);
  if (label.video) video_.encode(shrunk_, *label.video, out.video);
}

}  // namespace foretrack
