// foretrack demo: a flight in simulation, every service in its own process.
#include "services/operator/demo.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <memory>

#include "services/cli/commands.hpp"
#include "services/common/options.hpp"
#include "services/config/load_params.hpp"
#include "services/config/load_scenario.hpp"
#include "services/operator/view.hpp"
#include "services/launch/domain.hpp"

namespace foretrack {
namespace {

struct DemoArguments {
  DemoOptions options;
  std::string out;
  int domain = -1;
  ScenarioOverrides overrides;
};

int run(DemoArguments arguments) {
  auto& [options, out, domain, overrides] = arguments;
  auto& spec = options.spec;
  if (!spec.params_file.empty()) load_params(spec.params_file);  // throws what is wrong in it
  overrides.map = spec.map == "known" ? MapSource::kKnown : MapSource::kDepth;
  options.scenario = load_scenario(spec.scenario, overrides);
  spec.duration_s = options.scenario.duration_s;
  spec.seed = overrides.seed;
  if (overrides.track_file) spec.track_file = *overrides.track_file;
  if (overrides.pedestrian) spec.pedestrian = *overrides.pedestrian;
  std::optional<FreeDomain> own;
  if (domain < 0) domain = own.emplace().id();
  spec.domain = domain;
  options.folder = out.empty() ? fmt::format("flights/{}-{:%Y%m%d-%H%M%S}", options.scenario.name,
                                             fmt::localtime(std::time(nullptr)))
                               : out;
  set_up_logging(is_terminal() && !options.headless ? "off" : "warning");
  fmt::print("{} for {:.0f} s, vehicle {}, DDS domain {}; Ctrl-C ends it early\n",
             options.scenario.name, spec.duration_s, spec.vehicle, spec.domain);
  return run_demo(options);
}

}  // namespace

std::function<int()> prepare_demo(CLI::App& app) {
  auto arguments = std::make_shared<DemoArguments>();
  auto& [options, out, domain, overrides] = *arguments;
  app.add_option("--scenario", options.spec.scenario, "Shipped scenario or file")
      ->capture_default_str();
  app.add_option("--for", overrides.duration_s, "Seconds; default: the scenario's")
      ->check(CLI::PositiveNumber);
  app.add_option("--seed", overrides.seed, "Of everything random in the scenario");
  app.add_option("--track", overrides.track_file, "Walk as a pedestrian of this recording")
      ->check(CLI::ExistingFile);
  app.add_option("--pedestrian", overrides.pedestrian, "Which pedestrian of the recording");
  app.add_flag("--headless", options.headless, "A line a second instead of a screen");
  app.add_option("--out", out, "Folder; default: flights/<scenario>-<date>");
  app.add_option("--vehicle", options.spec.vehicle, "Vehicle name")->capture_default_str();
  app.add_option("--speed", options.spec.speed, "Simulated seconds in a second")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  app.add_option("--map", options.spec.map, "depth: built from images; known: the true one")
      ->check(CLI::IsMember({"depth", "known"}))
      ->capture_default_str();
  app.add_option("--params", options.spec.params_file, "Parameter file (YAML)")
      ->check(CLI::ExistingFile);
  app.add_option("--domain", domain, "DDS domain; default: a free one")->check(CLI::Range(0, 232));
  return [arguments] { return run(*arguments); };
}

}  // namespace foretrack
