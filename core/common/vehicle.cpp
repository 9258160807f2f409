// SPDX-License-Identifier: Apache-2.0
#include "core/common/vehicle.hpp"

#include <algorithm>

namespace foretrack {
namespace {

VehicleState interpolate(const VehicleState& a, const VehicleState& b, double stamp_s) {
  const double w = (stamp_s - a.stamp_s) / (b.stamp_s - a.stamp_s);
  VehicleState s;
  s.stamp_s = stamp_s;
  s.position_enu_m = (1.0 - w) * a.position_enu_m + w * b.position_enu_m;
  s.velocity_enu_m_s = (1.0 - w) * a.velocity_enu_m_s + w * b.velocity_enu_m_s;
  s.angular_velocity_body_rad_s =
      (1.0 - w) * a.angular_velocity_body_rad_s + w * b.angular_velocity_body_rad_s;
  s.q_world_body = a.q_world_body.slerp(w, b.q_world_body);
  return s;
}

}  // namespace

const VehicleState* VehicleHistory::newest() const {
  if (states_.empty()) return nullptr;
  return &states_[(next_ + states_.size() - 1) % states_.size()];
}

void VehicleHistory::add(const VehicleState& state) {
  if (const VehicleState* last = newest(); last && state.stamp_s <= last->stamp_s) return;
  if (states_.size() < capacity_) {
    states_.push_back(state);
    next_ = 0;
  } else {
    states_[next_] = state;
    next_ = (next_ + 1) % states_.size();
  }
}

std::optional<VehicleState> VehicleHistory::at(double stamp_s, double slack_s) const {
  if (states_.empty()) return std::nullopt;
  const auto nth = [&](std::size_t i) -> const VehicleState& {
    return states_[(next_ + i) % states_.size()];
  };
  const VehicleState &oldest = nth(0), &latest = nth(states_.size() - 1);
  const bool inside = stamp_s >= oldest.stamp_s - slack_s && stamp_s <= latest.stamp_s + slack_s;
  if (!inside) return std::nullopt;  // nor is NaN
  if (stamp_s <= oldest.stamp_s) return oldest;
  if (stamp_s >= latest.stamp_s) return latest;
  std::size_t low = 0, high = states_.size() - 1;
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (nth(middle).stamp_s <= stamp_s ? low : high) = middle;
  }
  return interpolate(nth(low), nth(high), stamp_s);
}

}  // namespace foretrack
