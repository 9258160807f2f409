// SPDX-License-Identifier: Apache-2.0
#include "services/operator/flight_snapshot.hpp"

#include <cmath>

namespace foretrack {
namespace {

const nav_msgs::msg::Odometry* vehicle_of(const FlightSnapshot& p) {
  return p.vehicle_truth ? p.vehicle_truth : p.odometry;
}

}  // namespace

double distance_m(const FlightSnapshot& p) {
  const auto* vehicle = vehicle_of(p);
  if (!vehicle) return -1.0;
  const auto& from = vehicle->pose().pose().position();
  if (p.target_truth) {
    const auto& to = p.target_truth->pose().pose().position();
    return std::hypot(to.x() - from.x(), to.y() - from.y());
  }
  using foretrack_msgs::msg::TargetState_Constants::STATUS_NONE;
  if (!p.target || p.target->status() == STATUS_NONE) return -1.0;
  return std::hypot(p.target->position_m()[0] - from.x(), p.target->position_m()[1] - from.y());
}

double speed_mps(const FlightSnapshot& p) {
  const auto* vehicle = vehicle_of(p);
  if (!vehicle) return -1.0;
  const auto& v = vehicle->twist().twist().linear();
  return std::hypot(v.x(), v.y(), v.z());
}

}  // namespace foretrack
