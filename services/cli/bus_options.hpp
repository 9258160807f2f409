// SPDX-License-Identifier: Apache-2.0
// The arguments of the commands that only look at the bus.
#pragma once

#include <CLI/CLI.hpp>

#include "services/cli/vehicle_section.hpp"
#include "services/common/node.hpp"
#include "services/common/options.hpp"

namespace foretrack {

/// What things are called (add_names_options), --interface, --security and --domain (default
/// $ROS_DOMAIN_ID), and --params for the section "vehicle" of a parameter file.
inline void add_bus_options(CLI::App& app, NodeOptions& options, bool with_params = true) {
  add_names_options(app, options.names);
  app.add_option("--domain", options.domain_id, "DDS domain")
      ->envname("ROS_DOMAIN_ID")
      ->check(CLI::Range(0, 232))
      ->capture_default_str();
  add_network_options(app, options.interface, options.security);
  if (!with_params) return;
  app.add_option_function<std::string>(
      "--params",
      [&options](const std::string& file) {
        take_vehicle_section(load_vehicle(file), options.names);
      },
      "Parameter file, for what its section 'vehicle' calls things");
}

}  // namespace foretrack
