// SPDX-License-Identifier: Apache-2.0
// Messages of one vehicle, in the order of time, become its story.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "foretrack_msgs/msg/MissionCommand.h"
#include "foretrack_msgs/msg/MovingBodies.h"
#include "foretrack_msgs/msg/SafetyState.h"
#include "foretrack_msgs/msg/ServiceHealth.h"
#include "foretrack_msgs/msg/TargetState.h"
#include "nav_msgs/msg/Odometry.h"
#include "px4_msgs/msg/BatteryStatus.h"
#include "sensor_msgs/msg/CompressedImage.h"
#include "services/ground_station/report/flight_story.hpp"

namespace foretrack::station {

/// Values of a recording are not trusted: what is not finite or no enumerator is passed over.
class VehicleTeller {
 public:
  explicit VehicleTeller(std::string name) { story_.name = std::move(name); }

  void take(double time_s, const nav_msgs::msg::Odometry& message);
  void take(double time_s, const foretrack_msgs::msg::TargetState& message);
  void take(double time_s, const foretrack_msgs::msg::SafetyState& message);
  void take(double time_s, const foretrack_msgs::msg::MissionCommand& message);
  void take(double time_s, const foretrack_msgs::msg::ServiceHealth& message);
  void take(double time_s, const foretrack_msgs::msg::MovingBodies& message);
  void take(double time_s, const px4_msgs::msg::BatteryStatus& message);
  void take(double time_s, const sensor_msgs::msg::CompressedImage& message);

  /// After the last message.
  VehicleStory finish();

 private:
  using Safety = foretrack_msgs::msg::SafetyState;
  struct Gate {
    double time_s = 0.0;
    std::uint8_t mode = 0, reason = 0, phase = 0, end = 0;
    bool armed = false;
    std::uint64_t command_id = 0;
    std::uint8_t result = 0;
    std::string alarm = {}, holder = {};
  };
  void note(double time_s, StoryEvent::Kind kind, bool bad, std::string text);
  void compare(const Gate& now, const Safety& message);
  void tell_order(const Gate& now, const Safety& message);
  void lose(double time_s);
  void find(double time_s);

  VehicleStory story_;
  std::optional<Gate> gate_;
  std::optional<StoryPoint> place_;      // of the vehicle, the last
  std::optional<StoryPoint> person_;     // the last that was measured
  std::optional<double> seen_before_s_;  // the last state in which the person was tracked
  double person_time_s_ = 0.0;
  bool lost_ = false;
  std::map<std::string, std::string> troubles_;  // by service
  std::vector<std::uint8_t> picture_;
  bool wants_found_ = false;  // the next picture is of who was found again
};

}  // namespace foretrack::station
