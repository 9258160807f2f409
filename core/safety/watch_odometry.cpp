// SPDX-License-Identifier: Apache-2.0
#include "core/safety/watch_odometry.hpp"

#include <cmath>

namespace foretrack {
namespace {

constexpr double kSameClock_s = 0.1;  // by which the way of a message may vary
constexpr double kForget_s = 1.0;     // of the drift
constexpr double kMoves_m = 0.1, kStirs_m = 1e-3;

bool is_finite(const VehicleState& s) {
  return std::isfinite(s.stamp_s) && s.position_enu_m.allFinite() &&
         s.velocity_enu_m_s.allFinite() && s.q_world_body.coeffs().allFinite() &&
         s.angular_velocity_body_rad_s.allFinite();
}

// Stamps that keep their distance to our steady clock are as good as before, whatever was set.
bool goes_on(const OdometryWatch& watch, const VehicleState& state, double at_s) {
  const double way_s = (at_s - state.stamp_s) - (watch.at_s - watch.state.stamp_s);
  return watch.at_s >= 0.0 && std::abs(way_s) < kSameClock_s;
}

bool is_believable(const OdometryWatch& watch, const VehicleState& state, double at_s,
                   const Moment& moment, const OdometryParams& p) {
  if (!is_finite(state)) return false;
  if (goes_on(watch, state, at_s)) return state.stamp_s > watch.state.stamp_s;
  const double age_s = moment.stamp_now_s - (moment.now_s - at_s) - state.stamp_s;
  return age_s <= p.oldest_s && age_s >= -p.future_s;
}

// What the step is beyond what the velocities tell. Where stamps and arrivals differ, the way took
// longer, or a clock was set: the one that explains the step was right.
Vec3 unexplained_m(const OdometryWatch& watch, const VehicleState& state, double at_s) {
  const Vec3 mean = 0.5 * (watch.state.velocity_enu_m_s + state.velocity_enu_m_s);
  const Vec3 step = state.position_enu_m - watch.state.position_enu_m;
  const Vec3 by_stamp = step - (state.stamp_s - watch.state.stamp_s) * mean;
  const Vec3 by_arrival = step - (at_s - watch.at_s) * mean;
  const bool in_order = state.stamp_s > watch.state.stamp_s;
  if (goes_on(watch, state, at_s) || (in_order && by_stamp.norm() < by_arrival.norm()))
    return by_stamp;
  return by_arrival;
}

void compare(OdometryWatch& watch, const VehicleState& state, double at_s,
             const OdometryParams& p) {
  const Vec3 step_m = unexplained_m(watch, state, at_s);
  watch.drift_m = std::exp(-(at_s - watch.at_s) / kForget_s) * watch.drift_m + step_m;
  if (step_m.norm() > p.jump_m)
    watch.fault = OdometryFault::kJumps;
  else if (watch.drift_m.norm() > p.drift_m && watch.fault == OdometryFault::kNone)
    watch.fault = OdometryFault::kDisagrees;
  // While it brakes, a living odometry is told by its noise alone.
  const double moves_m = watch.fault == OdometryFault::kFrozen ? kStirs_m : kMoves_m;
  if ((state.position_enu_m - watch.moved_from_m).norm() > moves_m) {
    watch.moved_from_m = state.position_enu_m;
    watch.commanded_m = 0.0;
  }
}

}  // namespace

void take_odometry(OdometryWatch& watch, const VehicleState& state, double at_s,
                   const Moment& moment, const OdometryParams& params) {
  if (at_s < 0.0 || at_s == watch.seen_at_s) return;  // nothing new
  watch.seen_at_s = at_s;
  if (!is_believable(watch, state, at_s, moment, params)) {
    ++watch.refused;
    return;
  }
  if (watch.at_s >= 0.0) compare(watch, state, at_s, params);
  watch.state = state;
  watch.at_s = at_s;
}

OdometryFault watch_odometry(OdometryWatch& watch, const Vec3& commanded_enu_m_s, double dt_s,
                             double now_s, const OdometryParams& params) {
  if (watch.commanded_m == 0.0) watch.still_since_s = now_s;
  watch.commanded_m += dt_s * commanded_enu_m_s.norm();
  const bool frozen =
      watch.commanded_m > params.frozen_path_m && now_s - watch.still_since_s > params.frozen_s;
  const bool drifts = watch.drift_m.norm() > params.drift_m;
  if (frozen && watch.fault != OdometryFault::kFrozen) {
    watch.fault = OdometryFault::kFrozen;
    watch.moved_from_m = watch.state.position_enu_m;
  }
  if (!watch.latch.update(frozen || drifts, now_s, 0.0, params.settle_s))
    watch.fault = OdometryFault::kNone;
  return watch.fault;
}

}  // namespace foretrack
