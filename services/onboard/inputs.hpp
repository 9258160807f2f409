// SPDX-License-Identifier: Apache-2.0
// What the onboard services share: the vehicle's state.
#pragma once

#include <functional>

#include "core/common/vehicle.hpp"
#include "nav_msgs/msg/Odometry.h"
#include "services/common/service.hpp"
#include "services/convert/vehicle.hpp"

namespace foretrack {

/// The vehicle's odometry: its newest state and the history that images need.
class VehicleInput {
 public:
  /// `changed` is called after each wake-up that brought samples; may be empty.
  explicit VehicleInput(Service& service, std::function<void()> changed = {});

  const VehicleHistory& history() const { return history_; }
  /// Null: none came yet.
  const VehicleState* newest() const { return history_.newest(); }
  /// The last that came, whatever its stamp says, and when on the steady clock (simulated, if time
  /// is); −1: none yet. Who judges stamps for himself reads these.
  const VehicleState& last() const { return last_; }
  double arrived_s() const { return arrived_s_; }
  /// See ReaderCore.
  void pin_writer(double silence_s) { reader_.pin_writer(silence_s); }
  const EndpointStats& stats() const { return reader_.stats(); }
  /// By its stamp; infinite if none came yet.
  double age_s(double now_s) const;

 private:
  void add(const VehicleState& state);

  Reader<topics::Odometry> reader_;
  VehicleHistory history_;
  VehicleState last_;
  double arrived_s_ = -1.0;
};

}  // namespace foretrack
