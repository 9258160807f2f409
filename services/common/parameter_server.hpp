// SPDX-License-Identifier: Apache-2.0
// The six services by which ROS 2's tools list, read, describe and set a node's parameters.
#pragma once

#include <memory>
#include <vector>

#include "rcl_interfaces/msg/ParameterEvent.h"
#include "services/common/parameters.hpp"
#include "services/common/ros_server.hpp"
#include "services/common/topics.hpp"
#include "services/common/writer.hpp"

namespace foretrack {

/// For the node's thread. What was set is told on parameter_events, and logged.
class ParameterServer {
 public:
  ParameterServer(Node& node, Parameters& parameters);
  const std::vector<std::unique_ptr<RosServer>>& servers() const { return servers_; }

 private:
  template <class Request, class Response>
  void serve(const char* name, const char* type,
             std::function<void(const Request&, Response&)> answer);
  void serve_reading();
  void serve_setting();
  void tell(const std::vector<rcl_interfaces::msg::Parameter>& changed);

  Node& node_;
  Parameters& parameters_;
  Writer<topics::ParameterEvents> events_;
  std::vector<std::unique_ptr<RosServer>> servers_;
};

}  // namespace foretrack
