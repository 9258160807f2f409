// SPDX-License-Identifier: Apache-2.0
#include "core/safety/watch_image.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace foretrack {
namespace {

constexpr std::size_t kEveryValue = 16, kEveryDepth = 4;

// FNV-1a.
void mix(std::uint64_t& fingerprint, std::uint64_t value) {
  fingerprint = (fingerprint ^ value) * 1099511628211ULL;
}

struct Moments {
  double sum = 0.0, squares = 0.0;
  std::size_t count = 0;
  void add(double value) {
    sum += value;
    squares += value * value;
    ++count;
  }
  void write(ImageStatistics& out) const {
    if (count == 0) return;
    out.mean = sum / static_cast<double>(count);
    const double variance = squares / static_cast<double>(count) - out.mean * out.mean;
    out.deviation = std::sqrt(std::max(variance, 0.0));
  }
};

ImageFault confirm(ImageWatch& watch, ImageFault fault, const ImageStatistics& image,
                   double moved_m, double stamp_s, const ImageWatchParams& p) {
  watch.moved_m = image.fingerprint == watch.fingerprint ? watch.moved_m + moved_m : 0.0;
  watch.fingerprint = image.fingerprint;
  const bool frozen = watch.moved_m > p.frozen_motion_m;
  if (frozen) fault = ImageFault::kFrozen;
  if (fault != ImageFault::kNone) watch.seen = fault;
  const bool on = watch.latch.update(fault != ImageFault::kNone, stamp_s,
                                     frozen ? 0.0 : p.confirm_s, p.clear_s);
  return on ? watch.seen : ImageFault::kNone;
}

}  // namespace

ImageStatistics statistics_of(std::span<const std::uint8_t> values) {
  ImageStatistics out{.fingerprint = values.size()};
  Moments moments;
  for (std::size_t i = 0; i < values.size(); i += kEveryValue) {
    moments.add(values[i]);
    mix(out.fingerprint, values[i]);
  }
  moments.write(out);
  return out;
}

ImageStatistics statistics_of(std::span<const float> depths_m) {
  ImageStatistics out{.mean = std::numeric_limits<double>::infinity(),
                      .fingerprint = depths_m.size()};
  Moments moments;
  std::size_t looks = 0, answers = 0;
  for (std::size_t i = 0; i < depths_m.size(); i += kEveryDepth, ++looks) {
    if (depths_m[i] > 0.0F) ++answers;
    if (depths_m[i] > 0.0F && std::isfinite(depths_m[i])) moments.add(depths_m[i]);
    mix(out.fingerprint, std::bit_cast<std::uint32_t>(depths_m[i]));
  }
  moments.write(out);
  out.valid_share = looks == 0 ? 0.0 : static_cast<double>(answers) / static_cast<double>(looks);
  return out;
}

ImageFault watch_color(ImageWatch& watch, const ImageStatistics& image, double moved_m,
                       double stamp_s, const ImageWatchParams& params) {
  ImageFault fault = ImageFault::kNone;
  if (image.deviation < params.flat) fault = ImageFault::kCovered;
  if (image.mean < params.dark) fault = ImageFault::kDark;
  return confirm(watch, fault, image, moved_m, stamp_s, params);
}

ImageFault watch_depth(ImageWatch& watch, const ImageStatistics& image, double moved_m,
                       double stamp_s, const ImageWatchParams& params) {
  const bool covered = image.valid_share < params.valid_share || image.mean < params.near_m;
  // Where nothing is within reach, all images are the same.
  return confirm(watch, covered ? ImageFault::kCovered : ImageFault::kNone, image,
                 std::isfinite(image.mean) ? moved_m : 0.0, stamp_s, params);
}

std::string_view to_string(ImageFault fault) {
  constexpr std::array<std::string_view, 4> names = {"", "frozen", "dark", "covered"};
  return names[static_cast<std::size_t>(fault)];
}

}  // namespace foretrack
