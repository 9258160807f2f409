// SPDX-License-Identifier: Apache-2.0
// PX4's own estimate as the odometry of all stages: for vehicles without another estimator.
#pragma once

#include "nav_msgs/msg/Odometry.h"
#include "px4_msgs/msg/VehicleOdometry.h"
#include "services/common/service.hpp"
#include "tf2_msgs/msg/TFMessage.h"

namespace foretrack {

/// Republishes each fmu/out/vehicle_odometry as odometry, and as tf for who listens. PX4's stamps
/// must be in this machine's time (its UXRCE_DDS_SYNCT is 1, the default).
class Px4Odometry {
 public:
  explicit Px4Odometry(Service& service);

 private:
  void notice_reset(int counter);

  int resets_ = -1;  // that its estimate has had; -1: not known
  Reader<topics::Px4VehicleOdometry> reader_;
  Writer<topics::Odometry> odometry_;
  Writer<topics::Transforms> transforms_;
};

}  // namespace foretrack
