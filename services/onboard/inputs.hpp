// SPDX-License-Identifier: Apache-2.0
// What the onboard services share: the vehicle's state, and how long they wait.
#pragma once

#include <cmath>
#include <functional>
#include <memory>

#include "core/common/vehicle.hpp"
#include "nav_msgs/msg/Odometry.h"
#include "services/common/service.hpp"
#include "services/convert/vehicle.hpp"
#include "services/onboard/transform_input.hpp"

namespace foretrack {

/// An image may arrive before the odometry of its stamp, which comes at 30 Hz or more: so long it
/// is waited for.
inline constexpr double kPoseWait_s = 0.05;
/// Time that goes back further means that its source, e.g. a simulation, was started anew.
inline constexpr double kRestart_s = 1.0;

/// Lines and markers for other tools are drawn ten times a second at most.
class DrawingPace {
 public:
  /// True if the last drawing was long enough ago; what asks draws now.
  bool is_due(double now_s) {
    if (std::abs(now_s - drawn_s_) < kPeriod_s) return false;
    drawn_s_ = now_s;
    return true;
  }

 private:
  static constexpr double kPeriod_s = 0.1;
  double drawn_s_ = -1e9;
};

/// The vehicle's odometry: its newest state and the history that images need. Odometry of another
/// frame than the map is brought there by tf, or as the options say.
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
  OdometryFrames frames();

  Service& service_;
  std::unique_ptr<TransformInput> transforms_;  // once odometry of another frame comes
  Reader<topics::Odometry> reader_;
  VehicleHistory history_;
  VehicleState last_;
  double arrived_s_ = -1.0;
};

}  // namespace foretrack
