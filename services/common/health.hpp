// SPDX-License-Identifier: Apache-2.0
// ServiceHealth once a second, and the same as a ROS 2 diagnostic.
#pragma once

#include <string_view>
#include <vector>

#include "diagnostic_msgs/msg/DiagnosticArray.h"
#include "foretrack_msgs/msg/ServiceHealth.h"
#include "services/common/loop.hpp"
#include "services/common/process_stats.hpp"
#include "services/common/topics.hpp"
#include "services/common/writer.hpp"

namespace foretrack {

/// Under which ServiceHealth tells of messages that were refused before they were read.
inline constexpr std::string_view kWireTopic = "the network";

class Health {
 public:
  explicit Health(Node& node);

  /// Degraded until the reason is empty again: an input is missing or bad.
  void set_degraded(const std::string& reason);
  /// A value of the diagnostic that stays: a parameter that others need to know.
  void set_fact(const std::string& key, const std::string& value);
  /// Call it once a second.
  void publish(LoopStats loop, bool stopping);

 private:
  void fill(LoopStats loop, bool stopping, double elapsed_s);
  foretrack_msgs::msg::TopicCount count_of(const EndpointStats& stats, double elapsed_s);
  void publish_diagnostic();

  Node& node_;
  Writer<topics::ServiceHealth> health_;
  Writer<topics::Diagnostics> diagnostics_;
  CpuMeter cpu_;
  std::chrono::steady_clock::time_point started_;
  std::chrono::steady_clock::time_point last_;
  std::string degraded_;
  std::vector<diagnostic_msgs::msg::KeyValue> facts_;
  std::vector<std::uint64_t> counted_;  // samples of each endpoint at the last call
  std::size_t next_ = 0;
};

}  // namespace foretrack
