// SPDX-License-Identifier: Apache-2.0
// How a topic's name becomes the name on the wire, as ROS 2 and PX4 spell it.
#pragma once

#include <string>
#include <string_view>

#include "services/common/roles.hpp"

namespace foretrack {

enum class Scope {
  kVehicle,  // rt/<vehicle>/<name>
  kShared,   // rt/<name>: ROS 2's tools look there (tf, diagnostics)
  kClock,    // rt/<clock_topic>
  kPx4,      // rt/[<px4_namespace>/]<name>[_v<N>]
};

struct TopicInfo {
  std::string_view name;
  Scope scope;
  const char* profile;     // of qos/profiles.xml
  Roles writers;           // who may write it where DDS-Security is on; all that belong may read
  bool versioned = false;  // PX4 appends the message's version, unless it is 0
};

struct Names {
  std::string vehicle = "uav1";
  std::string clock_topic = "clock";
  std::string px4_namespace;           // empty, or px4_<n>
  int px4_vehicle_status_version = 1;  // 0: PX4 1.15; 1: PX4 1.16 and 1.17
};

/// Throws std::invalid_argument if a name is not one that ROS 2 allows.
void validate_or_throw(const Names& names);

std::string topic_name(const TopicInfo& info, const Names& names);

}  // namespace foretrack
