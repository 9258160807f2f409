// SPDX-License-Identifier: Apache-2.0
// The subcommands that speak DDS: the services of the vehicle, one by one or together, and the
// simulator.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <memory>
#include <thread>

#include "services/cli/commands.hpp"
#include "services/cli/scenario_options.hpp"
#include "services/cli/vehicle_file.hpp"
#include "services/common/px4_releases.hpp"
#include "services/files/config/load_params.hpp"
#include "services/files/config/load_scenario.hpp"
#include "services/launch/launcher.hpp"
#include "services/offline/people/load_person.hpp"
#include "services/onboard/onboard.hpp"
#include "services/simulator/around_px4.hpp"
#include "services/simulator/simulator_service.hpp"

namespace foretrack {
namespace {

// Signals before the first thread, so that no thread of DDS is interrupted.
template <class Run>
int run_until_stopped(const ServiceOptions& options, Run run) {
  Stop stop;
  const SignalStop signals(stop);
  set_up_logging(options.log_level);
  run(stop);
  return 0;
}

TrackerParams params_of(const ServiceOptions& options) {
  return options.params_file.empty() ? TrackerParams{} : load_params(options.params_file);
}

int print_params(const ServiceOptions& options, const char* stage) {
  TrackerParams params = params_of(options);
  fmt::print("{}", yaml_of_params(params, stage));
  return 0;
}

std::function<int()> prepare_onboard_service(CLI::App& app, const OnboardService& service) {
  const auto options = std::make_shared<ServiceOptions>();
  add_options(app, *options);
  return [&app, options, service] {
    take_vehicle_file(app, options->config_file);
    if (options->print_params) return print_params(*options, service.params);
    const TrackerParams params = params_of(*options);
    return run_until_stopped(*options, [&](Stop& stop) { service.run(*options, params, stop); });
  };
}

template <int kIndex>
Command onboard_command() {
  const OnboardService& service = onboard_services()[kIndex];
  return {service.name, service.summary,
          [](CLI::App& app) { return prepare_onboard_service(app, onboard_services()[kIndex]); }};
}

struct StageOptions {
  ServiceOptions service;
  StageChoice with;
};

std::shared_ptr<StageOptions> add_stage_options(CLI::App& app) {
  const auto o = std::make_shared<StageOptions>();
  add_options(app, o->service);
  app.add_flag("!--no-mapping", o->with.mapping, "a known map comes from elsewhere");
  app.add_flag("!--no-fleet", o->with.fleet, "other vehicles are neither told nor heard");
  return o;
}

std::function<int()> prepare_stages(CLI::App& app) {
  const auto o = add_stage_options(app);
  return [&app, o] {
    take_vehicle_file(app, o->service.config_file);
    if (o->service.print_params) return print_params(o->service, "");
    const TrackerParams params = params_of(o->service);
    return run_until_stopped(o->service,
                             [&](Stop& stop) { run_stages(o->service, params, o->with, stop); });
  };
}

// A process that ends is started again at once, and a word says so.
int supervise(const std::vector<ProcessSpec>& processes, const std::string& log_level) {
  Stop stop;
  const SignalStop signals(stop);
  set_up_logging(log_level);
  Launcher launcher({});
  for (const auto& process : processes) launcher.add(process);
  while (!stop.requested() && !launcher.any_given_up()) {
    for (const auto& line : launcher.poll()) spdlog::error("onboard: {}", line);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const bool failed = launcher.any_given_up();
  launcher.stop();
  return failed ? 1 : 0;
}

// It never ends a flight: where it cannot record, it says so.
ProcessSpec black_box_process(const ServiceOptions& o) {
  auto words = arguments_of(o);
  words.insert(words.begin(), "black_box");
  words.insert(words.end(), {"--record-gb", fmt::format("{}", o.record.limit_gb), "--record-days",
                             fmt::format("{}", o.record.limit_days)});
  if (!o.record.folder.empty()) words.insert(words.end(), {"--record-dir", o.record.folder});
  if (o.record.images) words.push_back("--record-images");
  return {.name = "black_box", .arguments = std::move(words), .always = true, .needed = false};
}

std::function<int()> prepare_onboard(CLI::App& app) {
  const auto o = add_stage_options(app);
  return [&app, o] {
    take_vehicle_file(app, o->service.config_file);
    if (o->service.print_params) return print_params(o->service, "");
    params_of(o->service);  // throws what a user must correct
    const auto process = [&](const char* name, std::vector<std::string> words) {
      words.insert(words.begin(), name);
      return ProcessSpec{.name = name, .arguments = std::move(words), .always = true};
    };
    auto stages = arguments_of(o->service);
    if (!o->with.mapping) stages.push_back("--no-mapping");
    if (!o->with.fleet) stages.push_back("--no-fleet");
    std::vector<ProcessSpec> processes = {process("safety_gate", arguments_of(o->service)),
                                          process("stages", stages)};
    if (!o->service.record.off) processes.push_back(black_box_process(o->service));
    return supervise(processes, o->service.log_level);
  };
}

struct SimulatorArguments {
  ServiceOptions service;
  std::string scenario = "t_intersection", map;
  ScenarioOverrides overrides;
  SimulatorOptions simulator;
};

std::shared_ptr<SimulatorArguments> add_simulator_options(CLI::App& app) {
  const auto o = std::make_shared<SimulatorArguments>();
  add_options(app, o->service);
  app.add_option("--scenario", o->scenario, "shipped name or file")->capture_default_str();
  app.add_option("--map", o->map, "known or depth")->check(CLI::IsMember({"known", "depth"}));
  app.add_option("--seed", o->overrides.seed, "of everything random");
  add_settings(app, o->overrides);
  app.add_option("--for", o->overrides.duration_s, "seconds to simulate");
  app.add_option("--track", o->overrides.track_file, "walk as this recorded pedestrian");
  app.add_option("--pedestrian", o->overrides.pedestrian, "number of the pedestrian in the track");
  app.add_flag("--endless", o->simulator.endless, "go on after the scenario's duration");
  app.add_option("--people-wait", o->simulator.people_wait_s,
                 "people stand until the vehicle flies in offboard mode, at most so many seconds")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_flag("--camera", o->overrides.color_images, "render images instead of landmarks");
  return o;
}

using RunSimulator = void (*)(const ServiceOptions&, const Scenario&, const SimulatorOptions&,
                              Stop&);

int simulate_scenario(SimulatorArguments& o, RunSimulator run) {
  if (!o.map.empty()) o.overrides.map = o.map == "known" ? MapSource::kKnown : MapSource::kDepth;
  const Scenario scenario = load_scenario(o.scenario, o.overrides);
  o.simulator.person = person_of(scenario);
  o.simulator.bystanders = bystanders_of(scenario);
  return run_until_stopped(o.service,
                           [&](Stop& stop) { run(o.service, scenario, o.simulator, stop); });
}

std::function<int()> prepare_simulator(CLI::App& app) {
  const auto o = add_simulator_options(app);
  add_vehicles(app, o->overrides);
  app.add_option("--speed", o->simulator.speed, "simulated seconds in a second")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  return [o] { return simulate_scenario(*o, run_simulator); };
}

// Here the release may be left out: --px4 says whose vehicle it is.
std::function<int()> prepare_simulate(CLI::App& app) {
  const auto o = add_simulator_options(app);
  o->simulator.people_wait_s = 3600.0;
  app.remove_option(app.get_option("--px4"));
  const auto take = [o](const std::string& release) {
    const bool any = release.empty() || release == "true" || release == "auto";
    if (!any) check_px4_release(release);
    o->service.names.px4_release = any ? "" : release;
  };
  app.add_option_function<std::string>(
         "--px4", take, "the vehicle is PX4's, in its own simulation; its release, or auto")
      ->expected(0, 1)
      ->required();
  return [o] { return simulate_scenario(*o, run_around_px4); };
}

}  // namespace

std::vector<Command> service_commands() {
  return {onboard_command<0>(),
          onboard_command<1>(),
          onboard_command<2>(),
          onboard_command<3>(),
          onboard_command<4>(),
          onboard_command<5>(),
          {"stages", "all services of the vehicle but the gate, in one process", prepare_stages},
          {"onboard", "the vehicle: the stages and the gate, each started again when it ends",
           prepare_onboard},
          {"black_box", "what onboard records of each flight", prepare_black_box},
          {"check", "whether the vehicle would start with its file", prepare_check},
          {"simulator", "vehicle, cameras and person of a scenario", prepare_simulator},
          {"simulate", "cameras and person of a scenario around a vehicle of PX4's simulation",
           prepare_simulate}};
}

}  // namespace foretrack
