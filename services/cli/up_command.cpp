// SPDX-License-Identifier: Apache-2.0
// foretrack up: every service and the simulator, each as its own process, until Ctrl-C. The vehicle
// is ordered to start.
#include <chrono>
#include <cstdio>
#include <limits>
#include <memory>
#include <thread>

#include "services/cli/commands.hpp"
#include "services/cli/scenario_options.hpp"
#include "services/common/node.hpp"
#include "services/common/options.hpp"
#include "services/common/stop.hpp"
#include "services/common/time_now.hpp"
#include "services/files/config/load_params.hpp"
#include "services/files/config/load_scenario.hpp"
#include "services/launch/flight_processes.hpp"
#include "services/operator/order_sender.hpp"

namespace foretrack {
namespace {

struct UpArguments {
  FlightSpec spec;
  ScenarioOverrides overrides;
  std::string out = "flights/up";
  double for_s = std::numeric_limits<double>::infinity();
};

NodeOptions node_options(const FlightSpec& spec, const std::string& vehicle) {
  NodeOptions options;
  options.service = "up";
  options.names.vehicle = vehicle;
  options.domain_id = spec.domain;
  options.interface = spec.interface;
  options.security = spec.security;
  options.ros_distro = spec.ros_distro;
  return options;
}

// What is simulated starts by itself.
struct Start {
  Start(const FlightSpec& spec, const std::string& vehicle) : node(node_options(spec, vehicle)) {
    order.insist();
  }
  Node node;
  OrderSender order{node, {.order = MissionOrder::kStart, .operator_name = "up"}};
};

int run_up(UpArguments arguments) {
  if (!arguments.spec.params_file.empty()) load_params(arguments.spec.params_file);
  auto& spec = arguments.spec;  // both throw what a user must correct
  spec.vehicles = fleet_names_of(load_scenario(spec.scenario, arguments.overrides));
  Stop stop;
  SignalStop signals(stop);
  set_up_logging("warning");
  arguments.spec.state_folder = arguments.out + "/state";
  Launcher launcher(std::filesystem::path(arguments.out) / "logs");
  for (auto& process : onboard_processes(arguments.spec)) launcher.add(std::move(process));
  launcher.add(simulator_process(arguments.spec));
  const std::string who = spec.vehicles.empty()
                              ? "vehicle " + spec.vehicle
                              : std::to_string(spec.vehicles.size()) + " vehicles";
  std::printf("%s, domain %d, logs in %s/logs; Ctrl-C ends it\n", who.c_str(), spec.domain,
              arguments.out.c_str());
  std::vector<std::unique_ptr<Start>> starts;
  if (spec.vehicles.empty()) starts.push_back(std::make_unique<Start>(spec, spec.vehicle));
  for (const FleetNames& names : spec.vehicles)
    starts.push_back(std::make_unique<Start>(spec, names.vehicle));
  const double begin_s = steady_s();
  while (!stop.requested() && steady_s() - begin_s < arguments.for_s && !launcher.any_given_up()) {
    for (const auto& line : launcher.poll()) std::printf("%s\n", line.c_str());
    std::fflush(stdout);
    for (const auto& start : starts) start->order.update();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  const bool failed = launcher.any_given_up();
  launcher.stop();
  return failed ? 1 : 0;
}

}  // namespace

std::function<int()> prepare_up(CLI::App& app) {
  auto arguments = std::make_shared<UpArguments>();
  auto& spec = arguments->spec;
  app.add_option("--scenario", spec.scenario, "Shipped scenario or file")->capture_default_str();
  add_vehicles(app, arguments->overrides);
  app.add_option("--vehicle", spec.vehicle, "Vehicle name")->capture_default_str();
  app.add_option("--domain", spec.domain, "DDS domain")
      ->envname("ROS_DOMAIN_ID")
      ->check(CLI::Range(0, 232))
      ->capture_default_str();
  add_network_options(app, spec.interface, spec.security);
  add_ros_option(app, spec.ros_distro);
  app.add_option("--speed", spec.speed, "Simulated seconds in a second")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  app.add_option("--map", spec.map, "depth: built from images; known: the true one")
      ->check(CLI::IsMember({"depth", "known"}))
      ->capture_default_str();
  app.add_option("--params", spec.params_file, "Parameter file (YAML)")->check(CLI::ExistingFile);
  app.add_option("--for", arguments->for_s, "Stop after so many seconds")
      ->check(CLI::PositiveNumber);
  app.add_option("--out", arguments->out, "Folder for the logs")->capture_default_str();
  return [arguments] { return run_up(*arguments); };
}

}  // namespace foretrack
