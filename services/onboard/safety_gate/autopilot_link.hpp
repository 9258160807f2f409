// SPDX-License-Identifier: Apache-2.0
// All that passes between the gate and the flight controller.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "core/safety/gate.hpp"
#include "px4_msgs/msg/BatteryStatus.h"
#include "px4_msgs/msg/FailsafeFlags.h"
#include "px4_msgs/msg/HomePosition.h"
#include "px4_msgs/msg/ManualControlSetpoint.h"
#include "px4_msgs/msg/OffboardControlMode.h"
#include "px4_msgs/msg/TrajectorySetpoint.h"
#include "px4_msgs/msg/VehicleCommand.h"
#include "px4_msgs/msg/VehicleCommandAck.h"
#include "px4_msgs/msg/VehicleLocalPosition.h"
#include "px4_msgs/msg/VehicleStatus.h"
#include "services/common/service.hpp"
#include "services/convert/px4_home.hpp"
#include "services/onboard/safety_gate/follow_mode_link.hpp"

namespace foretrack {

class AutopilotLink {
 public:
  /// In a dry run nothing is sent, and the flight controller is taken to have let us fly.
  AutopilotLink(Service& service, bool dry_run);

  /// Fills in what has come since the last call: the status, the answer, the battery.
  void read(GateInput& input);
  void send(const GateResult& result, double stamp_s);

  const AutopilotStatus& status() const { return status_; }
  /// That it speaks as another release of PX4 than is expected, so that some of it is not heard,
  /// and some misread; empty: it does not.
  const std::string& other_release() const { return other_release_; }
  /// That its stamps are not in our time; empty: they are.
  std::string time_fault() const;
  /// The release as which it speaks, where that is another one and nobody flies by this one: it
  /// stands, or the gate has just begun. Else empty.
  std::string_view better_release() const;
  /// Why it would refuse offboard mode, and the mode that a pilot selects; empty: nothing is known
  /// to hinder it.
  std::string hindrance() const;
  /// Where it would return to; none: it does not say.
  const std::optional<Vec3>& home_enu_m() const { return home_enu_m_; }

 private:
  void look_at_release();
  void hear_answer(const px4_msgs::msg::VehicleCommandAck& message);
  void ask(const GateResult& result, double stamp_s);
  void ask_for_home(const FlightBounds::Corner& place_enu_m, double stamp_s);

  Service& service_;
  bool dry_run_;
  double begun_s_;  // by this machine's clock
  Reader<topics::Px4VehicleStatus> status_reader_;
  Reader<topics::Px4FailsafeFlags> flags_reader_;
  Reader<topics::Px4VehicleCommandAck> ack_reader_;
  Reader<topics::Px4ManualControlSetpoint> sticks_reader_;
  Reader<topics::Px4BatteryStatus> battery_reader_;
  Reader<topics::Px4HomePosition> home_reader_;
  Reader<topics::Px4VehicleLocalPosition> position_reader_;
  Writer<topics::Px4TrajectorySetpoint> setpoint_;
  Writer<topics::Px4OffboardControlMode> heartbeat_;
  Writer<topics::Px4VehicleCommand> command_;
  std::optional<FollowModeLink> follow_mode_;  // none: no mode is registered
  AutopilotStatus status_;
  double status_at_s_ = -1.0;  // by arrival
  double ahead_s_ = 0.0;       // of our time are its stamps
  bool sticks_moved_ = false;
  std::string hindrance_, other_release_;
  std::string_view spoken_release_;  // empty: as expected, or none
  bool silence_alone_ = false;       // is what its failsafe can act for
  std::optional<BatteryState> battery_;
  std::optional<Vec3> home_enu_m_;
  std::optional<GlobalPlace> origin_;                 // of the world frame
  AutopilotRequest asked_ = AutopilotRequest::kNone;  // by the command that was written last
  std::deque<AutopilotAck> acks_;
  AutopilotAck ack_;  // that the gate is shown
};

}  // namespace foretrack
