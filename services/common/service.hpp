// SPDX-License-Identifier: Apache-2.0
// What every service is made of: node, loop and health.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "services/common/health.hpp"
#include "services/common/loop.hpp"
#include "services/common/node.hpp"
#include "services/common/options.hpp"
#include "services/common/parameter_server.hpp"
#include "services/common/reader.hpp"
#include "services/common/rosout.hpp"
#include "services/common/stop.hpp"
#include "services/common/topics.hpp"
#include "services/common/writer.hpp"

namespace foretrack {

/// Of the service's node.
NodeOptions node_options(const std::string& service, const ServiceOptions& options);

class Service {
 public:
  /// Throws as Node does.
  Service(const std::string& name, const ServiceOptions& options, Stop& stop);

  const ServiceOptions& options() const { return options_; }
  Node& node() { return node_; }
  Clock& clock() { return node_.clock(); }
  Loop& loop() { return loop_; }
  Health& health() { return health_; }

  /// Shows a stage's parameters to ROS 2's tools: a copy, which stays as it is.
  template <class P>
  void show(std::string_view section, const P& params) {
    const auto copy = std::make_shared<P>(params);
    shown_.push_back(copy);
    parameters_.add(section, rows(*copy), Change::kAtStart);
  }
  /// For those that may change in flight.
  Parameters& parameters() { return parameters_; }

  /// Until the stop is requested; publishes health every second and when it starts and ends.
  /// Announces the node to ROS 2 first.
  void run();

 private:
  ServiceOptions options_;
  Node node_;
  Loop loop_;
  Health health_;
  Rosout rosout_;
  Parameters parameters_;
  std::vector<std::shared_ptr<void>> shown_;
  std::optional<ParameterServer> server_;
};

}  // namespace foretrack
