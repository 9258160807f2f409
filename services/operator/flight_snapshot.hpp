// SPDX-License-Identifier: Apache-2.0
// All that is known of one flight at one moment: the newest of each topic.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "foretrack_msgs/msg/PlannedTrajectory.h"
#include "foretrack_msgs/msg/SafetyState.h"
#include "foretrack_msgs/msg/ServiceHealth.h"
#include "foretrack_msgs/msg/TargetIntention.h"
#include "foretrack_msgs/msg/TargetPrediction.h"
#include "foretrack_msgs/msg/TargetState.h"
#include "nav_msgs/msg/Odometry.h"

namespace foretrack {

/// How samples of one topic arrive here.
struct TopicFlow {
  std::string topic;  // as in services/common/topics.hpp: "target/state"
  std::string wire;   // as DDS has it: "rt/uav1/target/state"
  double rate_hz = 0.0;
  double age_s = -1.0;  // since the last sample; negative: none yet
  int writers = 0;      // that match our reader
  int readers = -1;     // of others on the topic; negative: not known
  std::uint64_t samples = 0;
  std::uint64_t incompatible_qos = 0;  // writers refused for their quality of service
  std::vector<std::pair<std::string, std::uint64_t>> rejected;  // by reason
  std::string refusal;  // the last of them in words: what, its value, and what was expected
};

/// A service's last word about itself.
struct ServiceReport {
  foretrack_msgs::msg::ServiceHealth health;
  double age_s = 0.0;          // since it came
  double clock_ahead_s = 0.0;  // its clock against ours, when it came
};

/// A null pointer: nothing came. The pointers are valid until the listener's next update.
struct FlightSnapshot {
  std::string vehicle;
  int domain = 0;
  bool this_machine_only = false;  // no other one can be heard
  std::string unsecured;           // why anybody can take part; empty: not so
  double now_s = 0.0;              // simulated, if there is such a clock
  double time_rate = -1.0;         // simulated seconds in a second; negative: real time
  const nav_msgs::msg::Odometry* odometry = nullptr;
  const nav_msgs::msg::Odometry* vehicle_truth = nullptr;
  const nav_msgs::msg::Odometry* target_truth = nullptr;
  const foretrack_msgs::msg::TargetState* target = nullptr;
  const foretrack_msgs::msg::TargetIntention* intention = nullptr;
  const foretrack_msgs::msg::TargetPrediction* prediction = nullptr;
  const foretrack_msgs::msg::PlannedTrajectory* plan = nullptr;
  const foretrack_msgs::msg::SafetyState* safety = nullptr;
  std::vector<ServiceReport> services;  // by name
  std::vector<TopicFlow> flows;
  bool map_is_static = false;               // a known map, sent once
  int clocks = 0;                           // that write simulated time
  std::vector<std::string> other_versions;  // whose types are others than ours, a sentence each
  std::vector<std::string> foreign;         // endpoints that can never match, one sentence each

  std::vector<std::string> other_vehicles;                     // whose topics discovery tells of
  bool simulated = false;                                      // a simulator is heard
  bool nobody_in_images = false;                               // the newest observation says so
  std::vector<std::pair<std::string, std::string>> published;  // topics and types of all writers
  std::vector<std::string_view> fitting_presets;  // whose topics are published, and not taken yet
  std::string px4_release;                        // that is expected
  std::string px4_spoken;                         // that the topics tell of; empty: none
  double px4_ahead_s = 0.0;  // stamps of the flight controller against this machine's clock

  /// Whether a topic is one that is looked at here, by its name on the wire.
  bool is_ours(std::string_view wire) const {
    for (const auto& f : flows)
      if (f.wire == wire) return true;
    return wire.starts_with("rt/" + vehicle + "/");
  }

  const TopicFlow* flow(std::string_view topic) const {
    for (const auto& f : flows)
      if (f.topic == topic) return &f;
    return nullptr;
  }
  const ServiceReport* service(std::string_view name) const {
    for (const auto& s : services)
      if (name == s.health.service().c_str()) return &s;
    return nullptr;
  }
};

/// Horizontal distance between vehicle and target (truth if it is there, else the estimate);
/// negative: not known.
double distance_m(const FlightSnapshot& snapshot);
/// Of the vehicle; negative: not known.
double speed_mps(const FlightSnapshot& snapshot);

}  // namespace foretrack
