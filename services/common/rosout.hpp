// SPDX-License-Identifier: Apache-2.0
// A service's log lines on /rosout, where ROS 2's tools look for them.
#pragma once

#include <memory>

#include "rcl_interfaces/msg/Log.h"
#include "services/common/topics.hpp"
#include "services/common/writer.hpp"

namespace spdlog::sinks {
class sink;
}

namespace foretrack {

/// Keeps the newest lines of each service that has a Rosout: those that begin with its name. Lines
/// may come from threads of DDS, which must not write to it: publish() does.
std::shared_ptr<spdlog::sinks::sink> rosout_sink();

/// For the node's thread. Only one of a service's name in a process gets the lines.
class Rosout {
 public:
  explicit Rosout(Node& node);
  ~Rosout();
  Rosout(const Rosout&) = delete;
  Rosout& operator=(const Rosout&) = delete;

  /// Writes what was logged since the last call.
  void publish();

 private:
  Node& node_;
  Writer<topics::Rosout> writer_;
};

}  // namespace foretrack
