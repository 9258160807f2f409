// SPDX-License-Identifier: Apache-2.0
// The arguments that every service has.
#pragma once

#include <string>
#include <vector>

#include "services/common/names.hpp"

namespace CLI {
class App;
}

namespace foretrack {

/// What the vehicle keeps of its flights.
struct BlackBoxOptions {
  bool off = false;
  bool images = false;  // also camera and depth images, with all who are in them
  std::string folder;   // empty: "recordings" in the state's folder
  double limit_gb = 20.0;
  double limit_days = 14.0;
};

struct ServiceOptions {
  Names names;
  /// Where a camera sits in the body (FLU), if no transforms shall be asked: x, y, z in metres,
  /// roll, pitch and yaw of a camera that looks along x, in radians. Empty: transforms say it.
  std::vector<double> color_mount, depth_mount;
  int domain_id = 0;
  bool use_sim_time = false;
  std::string params_file;          // empty: defaults
  bool print_params = false;        // print the parameters as a file and leave
  std::string ros_distro;           // see NodeOptions
  bool px4_odometry = false;        // PX4's own estimate is the vehicle's odometry
  bool dry_run = false;             // nothing is sent to the flight controller
  bool external_mode = false;       // a mode "Follow" is registered with it, for a pilot to select
  std::string interface;            // of the network; empty: see NodeOptions
  std::string security;             // folder of the identity; empty: see NodeOptions
  std::vector<std::string> peers;   // see NodeOptions
  std::string discovery_server;     // see NodeOptions
  std::string fleet_frame = "map";  // of the odometry: vehicles that name the same one share it
  std::string state_folder;         // where the gate remembers its mission; empty: nowhere
  BlackBoxOptions record;
  std::string config_file;  // of the vehicle, for what the command line does not say; may be empty
  std::string log_level = "info";
};

/// Those of add_names_options, and --config --domain --interface --security --peer
/// --discovery-server --params --print-params --use-sim-time --clock-topic --color-mount
/// --depth-mount --ros-distro --px4-odometry --dry-run --external-mode --fleet-frame --state-dir
/// --no-record --record-dir --record-gb --record-days --record-images --log-level. The domain's
/// default is $ROS_DOMAIN_ID, the state's folder is $STATE_DIRECTORY (as systemd sets it),
/// $XDG_STATE_HOME/foretrack or ~/.local/state/foretrack.
void add_options(CLI::App& app, ServiceOptions& options);

/// --vehicle --px4-namespace --px4 --preset --remap --base-frame --odometry-is-map: what things are
/// called. A wrong one throws std::invalid_argument while the words are parsed.
void add_names_options(CLI::App& app, Names& names);

/// --interface (default $FORETRACK_INTERFACE) and --security (default $FORETRACK_SECURITY): which
/// network interface DDS uses, and as whom.
void add_network_options(CLI::App& app, std::string& interface, std::string& security);

/// --peer (default $ROS_STATIC_PEERS) and --discovery-server (default $ROS_DISCOVERY_SERVER): how
/// others are found where multicast does not pass.
void add_meeting_options(CLI::App& app, std::vector<std::string>& peers,
                         std::string& discovery_server);

/// --ros-distro (default $ROS_DISTRO): in whose node list this appears.
void add_ros_option(CLI::App& app, std::string& ros_distro);

/// The words that make the same options of another process.
std::vector<std::string> arguments_of(const ServiceOptions& options);

/// Log lines to standard error, those of DDS among them. Call it once, after parsing.
void set_up_logging(const std::string& level);

}  // namespace foretrack
