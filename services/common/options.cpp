// SPDX-License-Identifier: Apache-2.0
#include "services/common/options.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "services/common/dds_log.hpp"
#include "services/common/presets.hpp"
#include "services/common/rosout.hpp"

namespace foretrack {
namespace {

constexpr int kHighestDomain = 232;  // the ports of higher ones do not exist

std::string default_state_folder() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string(value ? value : "");
  };
  if (const auto given = variable("STATE_DIRECTORY"); !given.empty()) return given;
  if (const auto state = variable("XDG_STATE_HOME"); !state.empty()) return state + "/foretrack";
  if (const auto home = variable("HOME"); !home.empty()) return home + "/.local/state/foretrack";
  return "/var/lib/foretrack";
}

}  // namespace

void add_network_options(CLI::App& app, std::string& interface, std::string& security) {
  app.add_option(
         "--interface", interface,
         "Network interface that DDS uses: a name, an address, or any. Without it only this "
         "machine is heard, unless qos/profiles.xml names interfaces")
      ->envname("FORETRACK_INTERFACE");
  app.add_option("--security", security,
                 "Folder of this process' identity (DDS-Security; an enclave as SROS2 makes it)")
      ->envname("FORETRACK_SECURITY");
}

void add_meeting_options(CLI::App& app, std::vector<std::string>& peers,
                         std::string& discovery_server) {
  app.add_option("--peer", peers,
                 "HOST or HOST:PORT where others are, if multicast does not reach them; several "
                 "with a ; between them. Uses the network that leads there")
      ->envname("ROS_STATIC_PEERS")
      ->expected(1)
      ->delimiter(';')
      ->take_all();
  app.add_option("--discovery-server", discovery_server,
                 "HOST:PORT of a Fast DDS discovery server, where all meet instead of by multicast")
      ->envname("ROS_DISCOVERY_SERVER");
}

void add_ros_option(CLI::App& app, std::string& ros_distro) {
  app.add_option("--ros-distro", ros_distro,
                 "Distribution of ROS 2 whose node list shows this: humble, or a later one")
      ->envname("ROS_DISTRO");
}

void add_names_options(CLI::App& app, Names& names) {
  app.add_option("--vehicle", names.vehicle, "Vehicle name; topics are rt/<vehicle>/...")
      ->capture_default_str();
  app.add_option("--px4-namespace", names.px4_namespace, "px4_<n> if PX4 has a namespace");
  app.add_option_function<std::string>(
         "--px4",
         [&names](const std::string& release) {
           names.px4_release = release == "auto" ? "" : release;
         },
         "Release of PX4, whose messages differ; auto, the default: as its topics tell")
      ->check(CLI::IsMember({"auto", "1.15", "1.16", "1.17", "1.18"}));
  using Words = std::vector<std::string>;
  app.add_option_function<Words>(
         "--preset",
         [&names](const Words& presets) {
           for (const auto& preset : presets) add_preset(names, preset);
         },
         "Topics of a usual driver: " + preset_names())
      ->allow_extra_args(false);
  app.add_option_function<Words>(
         "--remap",
         [&names](const Words& remaps) {
           for (const auto& remap : remaps) add_remap(names, remap);
         },
         "NAME:=TOPIC: another topic in a topic's place, as odometry:=mavros/local_position/odom")
      ->allow_extra_args(false);
  app.add_option("--base-frame", names.body_frame, "The body's frame in transforms and odometry")
      ->capture_default_str();
  app.add_flag("--odometry-is-map", names.odometry_is_map,
               "Odometry counts as the map's, whatever frame it names");
}

namespace {

void add_record_options(CLI::App& app, BlackBoxOptions& record) {
  app.add_flag("--no-record", record.off, "onboard records nothing");
  app.add_option("--record-dir", record.folder,
                 "Folder of onboard's recordings; default: recordings in --state-dir");
  app.add_option("--record-gb", record.limit_gb, "onboard's oldest recordings go beyond so many GB")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--record-days", record.limit_days, "onboard's recordings go after so many days")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--record-images", record.images,
               "onboard records camera and depth images, too, with all who are in them");
}

}  // namespace

void add_options(CLI::App& app, ServiceOptions& options) {
  auto& names = options.names;
  add_names_options(app, names);
  app.add_option(
         "--config", options.config_file,
         "File of the vehicle (YAML): its keys are these options, for what is not given here")
      ->check(CLI::ExistingFile);
  app.add_option("--domain", options.domain_id, "DDS domain")
      ->envname("ROS_DOMAIN_ID")
      ->check(CLI::Range(0, kHighestDomain))
      ->capture_default_str();
  add_network_options(app, options.interface, options.security);
  add_meeting_options(app, options.peers, options.discovery_server);
  app.add_option("--params", options.params_file, "Parameter file (YAML)")
      ->check(CLI::ExistingFile);
  app.add_flag("--print-params", options.print_params, "Print all parameters and leave");
  app.add_flag("--use-sim-time", options.use_sim_time, "Take the time from the clock topic");
  app.add_option("--clock-topic", names.clock_topic, "Clock topic")->capture_default_str();
  constexpr const char* kMount =
      "Where it sits in the body: x y z (m) roll pitch yaw (rad) of a camera that looks along x";
  app.add_option("--color-mount", options.color_mount, kMount)->expected(6);
  app.add_option("--depth-mount", options.depth_mount, kMount)->expected(6);
  add_ros_option(app, options.ros_distro);
  app.add_flag("--px4-odometry", options.px4_odometry,
               "safety_gate republishes PX4's estimate as the odometry of all, and as tf");
  app.add_flag(
      "--dry-run", options.dry_run,
      "safety_gate decides, shows and records, and sends nothing to the flight controller");
  app.add_flag("--external-mode", options.external_mode,
               "safety_gate registers a mode \"Follow\" with PX4, which a pilot selects to start");
  app.add_option(
         "--fleet-frame", options.fleet_frame,
         "Name of the world in which this vehicle's odometry is. Vehicles that name the same "
         "one share it; others are aligned by the person whom both see")
      ->check(CLI::Validator(
          [](const std::string& name) {
            return name.empty() || name.size() > 64 ? "1 to 64 letters expected" : "";
          },
          "NAME"))
      ->capture_default_str();
  options.state_folder = default_state_folder();
  app.add_option("--state-dir", options.state_folder,
                 "Folder in which safety_gate remembers its mission across a restart")
      ->capture_default_str();
  add_record_options(app, options.record);
  app.add_option("--log-level", options.log_level, "debug, info, warning, error or off")
      ->check(CLI::IsMember({"debug", "info", "warning", "error", "off"}))
      ->capture_default_str();
}

std::vector<std::string> arguments_of(const ServiceOptions& o) {
  std::vector<std::string> words = {
      "--vehicle",     o.names.vehicle,     "--domain",     std::to_string(o.domain_id),
      "--clock-topic", o.names.clock_topic, "--state-dir",  o.state_folder,
      "--log-level",   o.log_level,         "--base-frame", o.names.body_frame,
      "--fleet-frame", o.fleet_frame};
  const auto add = [&words](bool wanted, std::vector<std::string> more) {
    if (wanted) words.insert(words.end(), more.begin(), more.end());
  };
  add(!o.interface.empty(), {"--interface", o.interface});
  add(!o.security.empty(), {"--security", o.security});
  for (const auto& peer : o.peers) add(true, {"--peer", peer});
  add(!o.discovery_server.empty(), {"--discovery-server", o.discovery_server});
  add(!o.params_file.empty(), {"--params", o.params_file});
  add(!o.names.px4_namespace.empty(), {"--px4-namespace", o.names.px4_namespace});
  add(!o.names.px4_release.empty(), {"--px4", o.names.px4_release});
  for (const auto& [name, topic] : o.names.remaps) add(true, {"--remap", name + ":=" + topic});
  add(o.names.odometry_is_map, {"--odometry-is-map"});
  const auto add_mount = [&words](const char* option, const std::vector<double>& mount) {
    if (mount.empty()) return;
    words.emplace_back(option);
    for (const double value : mount) words.push_back(fmt::format("{}", value));
  };
  add_mount("--color-mount", o.color_mount);
  add_mount("--depth-mount", o.depth_mount);
  add(o.use_sim_time, {"--use-sim-time"});
  add(!o.ros_distro.empty(), {"--ros-distro", o.ros_distro});
  add(o.px4_odometry, {"--px4-odometry"});
  add(o.dry_run, {"--dry-run"});
  add(o.external_mode, {"--external-mode"});
  return words;
}

void set_up_logging(const std::string& level) {
  auto logger = spdlog::get("foretrack");
  if (!logger) {
    logger = spdlog::stderr_color_mt("foretrack");
    logger->sinks().push_back(rosout_sink());
  }
  logger->set_pattern("%H:%M:%S.%e %^%l%$ %v");
  logger->set_level(spdlog::level::from_str(level));
  spdlog::set_default_logger(logger);
  log_dds();
}

}  // namespace foretrack
