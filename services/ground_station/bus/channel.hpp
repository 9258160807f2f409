// SPDX-License-Identifier: Apache-2.0
// A stream of samples: a topic of one type, as clients and recordings see it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "services/common/time_now.hpp"

namespace foretrack::station {

using Bytes = std::vector<std::uint8_t>;

struct Channel {
  std::uint32_t id = 0;
  std::string topic;            // "/uav1/odometry"
  std::string wire;             // as DDS has it: "rt/uav1/odometry"; empty: the station's own
  std::string type;             // as DDS has it; empty: the station's own
  std::string encoding;         // of samples: "cdr", "json"
  std::string schema_name;      // "nav_msgs/msg/Odometry"
  std::string schema_encoding;  // "ros2msg", "omgidl", "jsonschema"; empty: nobody knows the type
  std::string schema;
  std::string profile;   // the quality of service that its writers offer, as in qos/profiles.xml
  bool latched = false;  // a late subscriber gets the last sample
};

struct Sample {
  std::uint32_t channel = 0;
  std::int64_t log_time_ns = 0;  // since 1970, when it came here
  std::shared_ptr<const Bytes> data;
};

/// What a source of samples tells, in its own thread. A closed channel may open again.
struct Outlet {
  std::function<void(const Channel&)> opened;
  std::function<void(std::uint32_t channel)> closed;
  std::function<void(const std::vector<Sample>&)> samples;
};

}  // namespace foretrack::station
