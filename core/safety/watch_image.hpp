// SPDX-License-Identifier: Apache-2.0
// Whether a camera still sees: images that are frozen, dark or covered, though their stamps go on.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "core/safety/latch.hpp"

namespace foretrack {

/// Why a camera is held to be blind.
enum class ImageFault : std::uint8_t { kNone, kFrozen, kDark, kCovered };
/// For logs and displays.
std::string_view to_string(ImageFault fault);

/// What little of an image is needed to tell.
struct ImageStatistics {
  double mean = 0.0;              // of the values, 0 to 255; of depth: of those within reach, in m
  double deviation = 0.0;         // of the same
  double valid_share = 1.0;       // of depth: pixels that have a value, or are free beyond reach
  std::uint64_t fingerprint = 0;  // the same for the same pixels
};

/// Of 8-bit values, colour or grey: every 16th of them. Cost: 60 µs for 640 × 480 × 3.
ImageStatistics statistics_of(std::span<const std::uint8_t> values);
/// Of depths in metres, every 4th. 0 and NaN are none; +infinity says that nothing is within reach,
/// and where all say so the mean is infinite.
ImageStatistics statistics_of(std::span<const float> depths_m);

/// When images are held to be frozen, dark or covered.
struct ImageWatchParams {
  double dark = 6.0;             // a mean below this is darkness, of 255
  double flat = 2.0;             // a deviation below this is something before the lens, of 255
  double valid_share = 0.02;     // fewer valid depths: covered
  double near_m = 0.15;          // or all of them nearer than this
  double confirm_s = 0.5;        // a fault is said after so long
  double clear_s = 1.0;          // and until it has been away for so long
  double frozen_motion_m = 0.3;  // the same image while the vehicle moves so far is a frozen one
};

/// What was seen of a camera's images so far.
struct ImageWatch {
  std::uint64_t fingerprint = 0;
  double moved_m = 0.0;  // with this fingerprint
  ImageFault seen = ImageFault::kNone;
  Latch latch;
};

/// Of one image, colour or depth; moved_m: how far the vehicle went (and turned, a radian as a
/// metre) since the last one. A scene may well look the same from the same place.
ImageFault watch_color(ImageWatch& watch, const ImageStatistics& image, double moved_m,
                       double stamp_s, const ImageWatchParams& params);
/// The same for depth images.
ImageFault watch_depth(ImageWatch& watch, const ImageStatistics& image, double moved_m,
                       double stamp_s, const ImageWatchParams& params);

}  // namespace foretrack
