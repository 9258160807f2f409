// SPDX-License-Identifier: Apache-2.0
#include "core/safety/watch_limits.hpp"

namespace foretrack {
namespace {

bool is_out_of_fence(const LimitInput& in, double inward_m) {
  FlightBounds fence = *in.bounds;
  fence.altitude_min_m = -std::numeric_limits<double>::infinity();
  fence.altitude_max_m = std::numeric_limits<double>::infinity();
  return room_m(fence, in.place_over_ground_m) < inward_m;
}

bool is_out_of_altitudes(const LimitWatch& watch, const LimitInput& in, double inward_m) {
  const double z = in.place_over_ground_m.z();
  return z > in.bounds->altitude_max_m - inward_m ||
         (watch.has_climbed && z < in.bounds->altitude_min_m + inward_m);
}

bool is_reached(LimitKind kind, bool already, const LimitWatch& watch, const LimitInput& in,
                const LimitParams& p) {
  const double inward_m = already ? p.inward_m : 0.0;
  switch (kind) {
    case LimitKind::kFence:
      return is_out_of_fence(in, inward_m);
    case LimitKind::kAltitude:
      return is_out_of_altitudes(watch, in, inward_m);
    case LimitKind::kBattery: {
      const double share = p.battery_reserve + (already ? p.battery_rise : 0.0);
      return p.battery_reserve > 0.0 && in.battery && in.battery->remaining < share;
    }
    default: {  // kLink
      const double heard_s = std::max(in.operator_at_s, watch.since_s);
      return p.link_timeout_s > 0.0 && in.now_s - heard_s > p.link_timeout_s;
    }
  }
}

}  // namespace

LimitVerdict watch_limits(LimitWatch& watch, const LimitInput& input, const LimitParams& params) {
  if (watch.since_s < 0.0) watch.since_s = input.now_s;
  watch.has_climbed =
      watch.has_climbed || input.place_over_ground_m.z() >= input.bounds->altitude_min_m;
  LimitVerdict verdict;
  for (int i = 0; i < kLimitCount; ++i) {
    const auto kind = static_cast<LimitKind>(i);
    Latch& latch = watch.latches[i];
    const bool reached = is_reached(kind, latch.on, watch, input, params);
    const auto reaction = static_cast<Reaction>(params.reactions[i]);
    if (latch.update(reached, input.now_s, params.confirm_s, params.clear_s) &&
        reaction > verdict.reaction)
      verdict = {reaction, kind};
  }
  return verdict;
}

}  // namespace foretrack
