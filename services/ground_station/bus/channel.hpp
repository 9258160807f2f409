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

/// Whether a sample can be read without those before it.
enum class Chain : std::uint8_t {
  kAlone,
  kKey,            // of a video: what follows needs it
  kNeedsPrevious,  // of a video: all back to the last key
};

struct Sample {
  std::uint32_t channel = 0;
  std::int64_t log_time_ns = 0;  // since 1970, when it came here
  std::shared_ptr<const Bytes> data;
  Chain chain = Chain::kAlone;
};

/// What a source of samples tells, in its own thread. A closed channel may open again.
struct Outlet {
  std::function<void(const Channel&)> opened;
  std::function<void(std::uint32_t channel)> closed;
  std::function<void(const std::vector<Sample>&)> samples;
};

}  // namespace foretrack::station
