// From an observation on the bus to the first setpoint that it caused, with every service running:
// wall time of each stage's answer after the observation was delivered, and what the vehicle's
// process costs. Usage: bench_dds_latency [known|depth [seconds [scenario]]]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <map>
#include <string>
#include <vector>

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

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
double seconds(const builtin_interfaces::msg::Time& time) {
  return time.sec() + 1e-9 * time.nanosec();
}

// Observations wait here until a sample shows that it was caused by them, or by a later one.
class Stage {
 public:
  explicit Stage(const char* name) : name_(name) {}
  void observed(double stamp_s) { waiting_.push_back({stamp_s, now_s()}); }
  void answered(double stamp_s) {
    while (!waiting_.empty() && waiting_.front().stamp_s <= stamp_s + 1e-6) {
      delays_ms_.push_back(1e3 * (now_s() - waiting_.front().at_s));
      waiting_.pop_front();
    }
  }
  void forget() { delays_ms_.clear(); }
  void print() {
    std::sort(delays_ms_.begin(), delays_ms_.end());
    const auto at = [this](double share) {
      return delays_ms_.empty()
                 ? 0.0
                 : delays_ms_[static_cast<std::size_t>(share * (delays_ms_.size() - 1))];
    };
    fmt::print("{:<14} {:6} {:8.1f} {:8.1f} {:8.1f}\n", name_, delays_ms_.size(), at(0.5), at(0.95),
               at(0.99));
  }

 private:
  struct Waiting {
    double stamp_s, at_s;
  };
  const char* name_;
  std::deque<Waiting> waiting_;
  std::vector<double> delays_ms_;
};

struct Stages {
  Stage target{"target"}, prediction{"prediction"}, plan{"plan"}, setpoint{"setpoint"};
  std::vector<Stage*> all() { return {&target, &prediction, &plan, &setpoint}; }
};

double cpu_s(const Launcher& launcher) {
  const auto usage = usage_of(launcher.processes().front().pid);
  return usage ? usage->cpu_s : 0.0;
}

int measure(const std::string& map, double duration_s, const std::string& scenario) {
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
    for (Stage* stage : stages.all()) stage->observed(seconds(m.header().stamp()));
  });
  loop.on_each(target, [&](const auto& m) { stages.target.answered(seconds(m.header().stamp())); });
  loop.on_each(prediction,
               [&](const auto& m) { stages.prediction.answered(seconds(m.header().stamp())); });
  loop.on_each(plan, [&](const auto& m) { stages.plan.answered(seconds(m.header().stamp())); });
  std::map<int, int> modes;
  loop.on_each(safety, [&](const auto& m) {
    ++modes[m.mode()];
    if (m.setpoint_valid()) stages.setpoint.answered(seconds(m.caused_by()));
  });
  const double begin_s = now_s();
  double cpu_begin_s = 0.0, measured_from_s = 0.0;
  loop.every_wall(0.1, [&] {
    for (const auto& line : launcher.poll()) fmt::print("{}\n", line);
    if (measured_from_s == 0.0 && now_s() - begin_s > kWarmUp_s) {
      measured_from_s = now_s();
      cpu_begin_s = cpu_s(launcher);
      modes.clear();
      for (Stage* stage : stages.all()) stage->forget();
    }
    if (now_s() - begin_s > kWarmUp_s + duration_s) stop.request();
  });
  ear.run();

  const double cpu = 100.0 * (cpu_s(launcher) - cpu_begin_s) / (now_s() - measured_from_s);
  const auto usage = usage_of(launcher.processes().front().pid);
  fmt::print("{} map, {} s; ms after the observation's delivery\n", map, duration_s);
  fmt::print("{:<14} {:>6} {:>8} {:>8} {:>8}\n", "", "n", "p50", "p95", "p99");
  for (Stage* stage : stages.all()) stage->print();
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
                            argc > 3 ? argv[3] : "t_intersection");
}
