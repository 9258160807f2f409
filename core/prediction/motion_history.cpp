// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/motion_history.hpp"

#include <algorithm>

namespace foretrack {
namespace {

constexpr double kThinning_s = 0.018;
constexpr double kLongestGap_s = 1.0;
constexpr double kJump_m = 1.0;  // from where the last state led: another walk, or somebody else

bool goes_on(const MotionHistory::Sample& last, const MotionHistory::Sample& next) {
  const double gap_s = next.stamp_s - last.stamp_s;
  if (gap_s < 0.0 || gap_s > kLongestGap_s) return false;
  const PlanarState led = advance(MotionModel::constant_velocity(), last.measured, gap_s);
  return (next.measured.position_m - led.position_m).norm() <= kJump_m;
}

}  // namespace

const MotionHistory::Sample& MotionHistory::before(double stamp_s, double age_s) const {
  for (int i = 0; i < count; ++i)
    if (stamp_s - back(i).stamp_s >= age_s - 1e-6) return back(i);
  return back(count - 1);
}

void remember(MotionHistory& h, const MotionHistory::Sample& sample) {
  if (h.count > 0 && !goes_on(h.back(0), sample)) h.count = 0;
  if (h.count > 0 && sample.stamp_s - h.back(0).stamp_s < kThinning_s) return;
  h.newest = (h.newest + 1) % MotionHistory::kCapacity;
  h.samples[h.newest] = sample;
  h.count = std::min(h.count + 1, MotionHistory::kCapacity);
}

}  // namespace foretrack
