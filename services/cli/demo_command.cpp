// SPDX-License-Identifier: Apache-2.0
// foretrack demo: a flight in simulation, every service in its own process.
#include <arpa/inet.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <ctime>
#include <memory>

#include "services/cli/commands.hpp"
#include "services/cli/scenario_options.hpp"
#include "services/common/options.hpp"
#include "services/files/config/load_params.hpp"
#include "services/files/config/load_scenario.hpp"
#include "services/ground_station/control/tokens.hpp"
#include "services/launch/domain.hpp"
#include "services/offline/people/load_person.hpp"
#include "services/operator/demo_flight.hpp"
#include "services/operator/fleet_demo.hpp"
#include "services/operator/view.hpp"

namespace foretrack {
namespace {

struct DemoArguments {
  DemoOptions options;
  std::string out;
  int domain = -1;
  bool no_station = false;
  ScenarioOverrides overrides;
};

constexpr unsigned short kStationPort = 8080;

// The preferred port, or any that is free; somebody else may still take it first.
unsigned short free_port(unsigned short preferred) {
  const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(preferred);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int on = 1;
  setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (bind(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
    address.sin_port = 0;
    bind(fd, reinterpret_cast<sockaddr*>(&address), sizeof address);
  }
  socklen_t size = sizeof address;
  getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size);
  close(fd);
  return ntohs(address.sin_port);
}

// The demo's station may command its simulated vehicle; its token is good for this flight alone.
void add_station(DemoOptions& options) {
  const auto port = std::to_string(free_port(kStationPort));
  const auto tokens = options.folder / "station.tokens";
  options.page = fmt::format("http://127.0.0.1:{}/#token={}", port,
                             station::Tokens::load_or_create(tokens).first());
  options.station =
      ProcessSpec{"station",
                  {"station", "--domain", std::to_string(options.spec.domain), "--port", port,
                   "--enable-control", "--token-file", tokens.string(), "--audit-file",
                   (options.folder / "station-audit.jsonl").string(), "--recordings",
                   (options.folder / "recordings").string()}};
  const auto pass_on = [&options](const char* option, const std::string& value) {
    if (value.empty()) return;
    for (const auto& word : {std::string(option), value})
      options.station->arguments.push_back(word);
  };
  pass_on("--params", options.spec.params_file);
  pass_on("--interface", options.spec.interface);
  pass_on("--security", options.spec.security);
}

int run(DemoArguments arguments) {
  auto& [options, out, domain, no_station, overrides] = arguments;
  auto& spec = options.spec;
  if (spec.scenario.empty())
    spec.scenario = overrides.vehicles.value_or(1) > 1 ? "fleet_blocks" : "t_intersection";
  if (!spec.params_file.empty()) load_params(spec.params_file);  // throws what is wrong in it
  if (overrides.color_images) {
    // Throws what is missing.
    person_of(options.scenario = load_scenario(spec.scenario, overrides));
    bystanders_of(options.scenario);
    spec.camera = true;
  }
  overrides.map = spec.map == "known" ? MapSource::kKnown : MapSource::kDepth;
  options.scenario = load_scenario(spec.scenario, overrides);
  spec.vehicles = fleet_names_of(options.scenario);
  spec.duration_s = options.scenario.duration_s;
  spec.seed = overrides.seed;
  spec.settings = overrides.settings;
  if (overrides.track_file) spec.track_file = *overrides.track_file;
  if (overrides.pedestrian) spec.pedestrian = *overrides.pedestrian;
  std::optional<FreeDomain> own;
  if (domain < 0) domain = own.emplace().id();
  spec.domain = domain;
  options.folder = out.empty() ? fmt::format("flights/{}-{:%Y%m%d-%H%M%S}", options.scenario.name,
                                             fmt::localtime(std::time(nullptr)))
                               : out;
  set_up_logging(is_terminal() && !options.headless ? "off" : "warning");
  fmt::print("{} for {:.0f} s, {}, DDS domain {}; Ctrl-C ends it early\n", options.scenario.name,
             spec.duration_s,
             spec.vehicles.empty() ? "vehicle " + spec.vehicle
                                   : fmt::format("{} vehicles", spec.vehicles.size()),
             spec.domain);
  if (!no_station) {
    add_station(options);
    fmt::print("page: {}\n", options.page);
  }
  std::fflush(stdout);
  return spec.vehicles.empty() ? fly_demo(options) : fly_fleet_demo(options);
}

}  // namespace

std::function<int()> prepare_demo(CLI::App& app) {
  auto arguments = std::make_shared<DemoArguments>();
  auto& [options, out, domain, no_station, overrides] = *arguments;
  options.spec.scenario.clear();
  app.add_option(
      "--scenario", options.spec.scenario,
      "Shipped scenario or file; default: t_intersection, of several vehicles fleet_blocks");
  add_vehicles(app, overrides);
  app.add_option("--for", overrides.duration_s, "Seconds; default: the scenario's")
      ->check(CLI::PositiveNumber);
  app.add_option("--seed", overrides.seed, "Of everything random in the scenario");
  add_settings(app, overrides);
  app.add_option("--track", overrides.track_file, "Walk as a pedestrian of this recording")
      ->check(CLI::ExistingFile);
  app.add_option("--pedestrian", overrides.pedestrian, "Which pedestrian of the recording");
  app.add_flag("--camera", overrides.color_images, "See rendered images through the pose network");
  app.add_flag("--headless", options.headless, "A line a second instead of a screen");
  app.add_option("--out", out, "Folder; default: flights/<scenario>-<date>");
  app.add_flag("--no-station", no_station, "Without the ground station and its page");
  app.add_option("--vehicle", options.spec.vehicle, "Vehicle name")->capture_default_str();
  app.add_option("--speed", options.spec.speed, "Simulated seconds in a second")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  app.add_option("--map", options.spec.map, "depth: built from images; known: the true one")
      ->check(CLI::IsMember({"depth", "known"}))
      ->capture_default_str();
  app.add_option("--params", options.spec.params_file, "Parameter file (YAML)")
      ->check(CLI::ExistingFile);
  add_network_options(app, options.spec.interface, options.spec.security);
  add_ros_option(app, options.spec.ros_distro);
  app.add_option("--domain", domain, "DDS domain; default: a free one")->check(CLI::Range(0, 232));
  return [arguments] { return run(*arguments); };
}

}  // namespace foretrack
