// SPDX-License-Identifier: Apache-2.0
// What every service is made of: node, loop and health.
#pragma once

#include <string>

#include "services/common/health.hpp"
#include "services/common/loop.hpp"
#include "services/common/node.hpp"
#include "services/common/options.hpp"
#include "services/common/reader.hpp"
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

  /// Until the stop is requested; publishes health every second and when it starts and ends.
  void run();

 private:
  ServiceOptions options_;
  Node node_;
  Loop loop_;
  Health health_;
};

}  // namespace foretrack
