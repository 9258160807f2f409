// SPDX-License-Identifier: Apache-2.0
// The arguments of the commands that only look at the bus.
#pragma once

#include <CLI/CLI.hpp>

#include "services/common/node.hpp"
#include "services/common/options.hpp"

namespace foretrack {

/// What things are called (add_names_options), --interface, --security and --domain (default
/// $ROS_DOMAIN_ID).
inline void add_bus_options(CLI::App& app, NodeOptions& options) {
  add_names_options(app, options.names);
  app.add_option("--domain", options.domain_id, "DDS domain")
      ->envname("ROS_DOMAIN_ID")
      ->check(CLI::Range(0, 232))
      ->capture_default_str();
  add_network_options(app, options.interface, options.security);
}

}  // namespace foretrack
