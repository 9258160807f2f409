// SPDX-License-Identifier: Apache-2.0
// The arguments of the commands that only look at the bus.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>

#include "services/cli/vehicle_file.hpp"
#include "services/common/node.hpp"
#include "services/common/options.hpp"

namespace foretrack {

/// What things are called (add_names_options), --interface, --security, --peer, --discovery-server
/// and --domain (default $ROS_DOMAIN_ID); --config for what is not said here.
inline void add_bus_options(CLI::App& app, NodeOptions& options) {
  add_names_options(app, options.names);
  app.add_option("--domain", options.domain_id, "DDS domain")
      ->envname("ROS_DOMAIN_ID")
      ->check(CLI::Range(0, 232))
      ->capture_default_str();
  add_network_options(app, options.interface, options.security);
  add_meeting_options(app, options.peers, options.discovery_server);
  add_ros_option(app, options.ros_distro);
  const auto file = std::make_shared<std::string>();
  app.add_option("--config", *file, "File of the vehicle (YAML), whose keys are these options")
      ->check(CLI::ExistingFile);
  app.parse_complete_callback(
      [&app, file] { take_vehicle_file(app, *file, OtherKeys::kLeftAlone); });
}

}  // namespace foretrack
