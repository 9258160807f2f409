// SPDX-License-Identifier: Apache-2.0
// Which processes make a flight, and their arguments.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "services/launch/launcher.hpp"

namespace foretrack {

/// What one vehicle of a fleet is called.
struct FleetNames {
  std::string vehicle, px4_namespace;
};

struct FlightSpec {
  std::string scenario = "t_intersection";  // shipped name or file
  std::string track_file;                   // walk as this recorded pedestrian; empty: no
  int pedestrian = -1;
  std::vector<std::string> settings;  // KEY=VALUE of the scenario
  double duration_s = 0.0;            // of simulated time; 0: for ever
  std::optional<std::uint64_t> seed;  // of the scenario; none: the scenario's own
  double speed = 1.0;                 // simulated seconds in a second
  std::string map = "depth";          // or "known": the true one, and no mapping
  bool camera = false;                // rendered images instead of landmarks
  std::string vehicle = "uav1";
  std::vector<FleetNames> vehicles;  // of a fleet, instead of `vehicle`
  int domain = 0;
  std::string interface;     // of the network; empty: this machine alone
  std::string security;      // folder of the identity that all of them have; empty: none
  std::string ros_distro;    // of ROS 2, in whose node list they appear; empty: Iron and later
  std::string params_file;   // of the stages; empty: defaults
  std::string state_folder;  // of the gate; what a former flight left there is removed
};

/// The services on the vehicle, in the order of the pipeline. Their names are their subcommands.
inline constexpr const char* kOnboardServices[] = {"perception", "mapping", "prediction",
                                                   "planning", "safety_gate"};
/// By the name of its process.
bool is_onboard(const std::string& process);

/// Without mapping, if the map is known. Of a fleet: two processes a vehicle, "uav1.stages" and
/// "uav1.safety_gate".
std::vector<ProcessSpec> onboard_processes(const FlightSpec& spec);
ProcessSpec simulator_process(const FlightSpec& spec);

}  // namespace foretrack
