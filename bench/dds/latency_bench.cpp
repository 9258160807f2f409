// SPDX-License-Identifier: Apache-2.0
// From an observation on the bus to the first setpoint that it caused, with every service running:
// wall time of each stage's answer after the observation was delivered, and what the vehicle's
// process costs. Usage: bench_dds_latency [known|depth [seconds [scenario [file]]]]; every single
// delay is written to the file.
#include <fmt/format.h>

#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "bench/dds/stage_delay.hpp"
#include "foretrack_msgs/msg/PlannedTrajectory.h"
#include "foretrack_msgs/msg/SafetyState.h"
#include "foretrack_msgs/msg/TargetObservation.h"
#include "foretrack_msgs/msg/TargetPrediction.h"
#include "foretrack_msgs/msg/TargetState.h"
#include "services/common/service.hpp"
#include "services/launch/domain.hpp"
#include "services/launch/launcher.hpp"
#include "services/launch/usage.hpp"

namespace foretrack {
namespace {

constexpr double kWarmUp_s = 5.0;

double seconds(const builtin_interfaces::msg::Time& time) {
  return time.sec() + 1e-9 * time.nanosec();
}

struct Stages {
  StageDelay target{"target"}, prediction{"prediction"}, plan{"plan"}, setpoint{"setpoint"};
  std::vector<StageDelay*> all() { return {&target, &prediction, &plan, &setpoint}; }
};

double cpu_s(const Launcher& launcher) {
  const auto usage = usage_of(launcher.processes().front().pid);
  return usage ? usage->cpu_s : 0.0;
}

int measure(const std::string& map, double duration_s, const std::string& scenario,
            const std::string& file) {
  const FreeDomain domain;
  fmt::print("domain {}\n", domain.id());  // for who wants to listen too
  std::fflush(stdout);
  const std::string program =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "foretrack";
  Launcher launcher("/tmp/foretrack_latency_bench", program);
  const std::vector<std::string> where = {"--domain", std::to_string(domain.id()),
                                          "--use-sim-time"};
  ProcessSpec onboard{"onboard", {"onboard"}},
      simulator{"simulator", {"simulator", "--endless", "--map", map, "--scenario", scenario}};
  if (map == "known") onboard.arguments.push_back("--no-mapping");
  for (ProcessSpec* spec : {&onboard, &simulator})
    spec->arguments.insert(spec->arguments.end(), where.begin(), where.end());
  launcher.add(onboard);
  launcher.add(simulator);

  Stop stop;
  ServiceOptions options;
  options.domain_id = domain.id();
  Service ear("latency_bench", options, stop);
  Reader<topics::TargetObservation> observation(ear.node());
  Reader<topics::TargetState> target(ear.node());
  Reader<topics::TargetPrediction> prediction(ear.node());
  Reader<topics::PlannedTrajectory> plan(ear.node());
  Reader<topics::SafetyState> safety(ear.node());
  Stages stages;
  Loop& loop = ear.loop();
  loop.on_each(observation, [&](const auto& m) {
    for (StageDelay* stage : stages.all()) stage->caused(seconds(m.header().stamp()), steady_s());
  });
  loop.on_each(target, [&](const auto& m) {
    stages.target.answered(seconds(m.header().stamp()), steady_s());
  });
  loop.on_each(prediction, [&](const auto& m) {
    stages.prediction.answered(seconds(m.header().stamp()), steady_s());
  });
  loop.on_each(
      plan, [&](const auto& m) { stages.plan.answered(seconds(m.header().stamp()), steady_s()); });
  std::map<int, int> modes;
  loop.on_each(safety, [&](const auto& m) {
    ++modes[m.mode()];
    if (m.setpoint_valid()) stages.setpoint.answered(seconds(m.caused_by()), steady_s());
  });
  const double begin_s = steady_s();
  double cpu_begin_s = 0.0, measured_from_s = 0.0;
  loop.every_wall(0.1, [&] {
    for (const auto& line : launcher.poll()) fmt::print("{}\n", line);
    if (measured_from_s == 0.0 && steady_s() - begin_s > kWarmUp_s) {
      measured_from_s = steady_s();
      cpu_begin_s = cpu_s(launcher);
      modes.clear();
      for (StageDelay* stage : stages.all()) stage->forget();
    }
    if (steady_s() - begin_s > kWarmUp_s + duration_s) stop.request();
  });
  ear.run();

  const double cpu = 100.0 * (cpu_s(launcher) - cpu_begin_s) / (steady_s() - measured_from_s);
  const auto usage = usage_of(launcher.processes().front().pid);
  fmt::print("{} map, {} s; ms after the observation's delivery\n", map, duration_s);
  fmt::print("{}", StageDelay::head());
  for (const StageDelay* stage : stages.all()) fmt::print("{}", stage->row());
  if (std::ofstream out(file); out)
    for (const StageDelay* stage : stages.all()) out << stage->rows();
  fmt::print("onboard: {:.1f} % of a core, {:.0f} MB\n", cpu,
             usage ? 1e-6 * usage->pss_bytes : 0.0);
  for (const auto& [mode, count] : modes) fmt::print("gate mode {}: {} reports\n", mode, count);
  launcher.stop();
  return 0;
}

}  // namespace
}  // namespace foretrack

int main(int argc, char** argv) {
  const std::string map = argc > 1 ? argv[1] : "depth";
  return foretrack::measure(map, argc > 2 ? std::stod(argv[2]) : 30.0,
                            argc > 3 ? argv[3] : "t_intersection", argc > 4 ? argv[4] : "");
}
