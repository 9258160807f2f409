// SPDX-License-Identifier: Apache-2.0
#include "core/perception/stream_pace.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack {
namespace {

constexpr double kRestart_s = 1.0;
constexpr double kEarly = 0.1;       // of a period: cameras jitter
constexpr double kAhead_s = 0.25;    // so much may wait on the link
constexpr double kDamping = 0.5;     // bytes grow about in proportion to the quality
constexpr double kMostChange = 1.5;  // from one picture to the next

double bytes_s(const StreamParams& params) {
  return params.bandwidth_kbit_s * 1000.0 / 8.0;
}

}  // namespace

bool is_due(StreamPace& pace, double stamp_s, const StreamParams& params) {
  if (!params.enabled) return false;
  const double period_s = 1.0 / params.rate_hz;
  if (pace.next_s - stamp_s > kRestart_s + period_s) pace = {.quality = pace.quality};
  if (stamp_s < pace.next_s - kEarly * period_s) return false;
  if (pace.allowance_s - stamp_s > kAhead_s) return false;
  // In step with the rate, not with the images, whose own rate may be no multiple of it.
  pace.next_s = std::max(pace.next_s + period_s, stamp_s + 0.5 * period_s);
  return true;
}

int quality_of(const StreamPace& pace, const StreamParams& params) {
  const int most = std::max(params.quality_min, params.quality_max);
  return std::clamp(static_cast<int>(std::lround(pace.quality)), params.quality_min, most);
}

void sent(StreamPace& pace, double stamp_s, double bytes, const StreamParams& params) {
  pace.allowance_s = std::max(pace.allowance_s, stamp_s) + bytes / bytes_s(params);
  const double ratio = bytes_s(params) / params.rate_hz / std::max(bytes, 1.0);
  const double change = std::clamp(std::pow(ratio, kDamping), 1.0 / kMostChange, kMostChange);
  const double most = std::max(params.quality_min, params.quality_max);
  pace.quality = std::clamp(quality_of(pace, params) * change, 1.0 * params.quality_min, most);
}

}  // namespace foretrack
