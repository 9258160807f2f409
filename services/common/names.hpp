// SPDX-License-Identifier: Apache-2.0
// How a topic's name becomes the name on the wire, as ROS 2 and PX4 spell it.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "services/common/roles.hpp"

namespace foretrack {

enum class Scope {
  kVehicle,  // rt/<vehicle>/<name>
  kShared,   // rt/<name>: ROS 2's tools look there (tf, diagnostics)
  kClock,    // rt/<clock_topic>
  kPx4,      // rt/[<px4_namespace>/]<name>[_v<N>], N the message's version in that release
};

struct TopicInfo {
  std::string_view name;
  Scope scope;
  const char* profile;      // of qos/profiles.xml
  Roles writers;            // who may write it where DDS-Security is on; all that belong may read
  bool any_writer = false;  // drivers write it: best-effort ones are heard, too
};

struct Names {
  std::string vehicle = "uav1";
  std::string clock_topic = "clock";
  std::string px4_namespace;                  // empty, or px4_<n>
  std::string px4_release;                    // "1.17"; empty: not told, so that of idl/px4_msgs
  std::string body_frame = "base_link";       // as drivers and estimators call it
  bool odometry_is_map = false;               // whatever frame it names
  std::map<std::string, std::string> remaps;  // names to topics of ROS 2: odometry → mavros/odom

  /// "uav1/base_link": frames of ours, so that those of two vehicles do not mix.
  std::string frame(std::string_view name) const { return vehicle + '/' + std::string(name); }
};

/// Throws std::invalid_argument if a name is not one that ROS 2 allows.
void validate_or_throw(const Names& names);

/// NAME:=TOPIC, with a name of topics.hpp. Throws std::invalid_argument that says what is wrong:
/// not of that form, a name that does not exist (with the nearest one), a topic that ROS 2 does not
/// allow.
void add_remap(Names& names, std::string_view text);

std::string topic_name(const TopicInfo& info, const Names& names);
/// The same without the version that PX4 appends, which changes with its releases.
std::string unversioned_topic_name(const TopicInfo& info, const Names& names);

}  // namespace foretrack
