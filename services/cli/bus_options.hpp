// SPDX-License-Identifier: Apache-2.0
// The arguments of the commands that only look at the bus.
#pragma once

#include <CLI/CLI.hpp>

#include "services/common/node.hpp"
#include "services/common/options.hpp"

namespace foretrack {

/// --vehicle, --interface, --security, --peer, --discovery-server and --domain (default
/// $ROS_DOMAIN_ID), PX4's namespace.
inline void add_bus_options(CLI::App& app, NodeOptions& options) {
  app.add_option("--vehicle", options.names.vehicle, "Vehicle name; topics are rt/<vehicle>/...")
      ->capture_default_str();
  app.add_option("--domain", options.domain_id, "DDS domain")
      ->envname("ROS_DOMAIN_ID")
      ->check(CLI::Range(0, 232))
      ->capture_default_str();
  add_network_options(app, options.interface, options.security);
  add_meeting_options(app, options.peers, options.discovery_server);
  app.add_option("--px4-namespace", options.names.px4_namespace, "px4_<n> if PX4 has a namespace");
}

}  // namespace foretrack
