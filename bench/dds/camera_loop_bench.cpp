// SPDX-License-Identifier: Apache-2.0
// The whole onboard loop on camera images in real time: rendered beforehand, replayed at 30 a
// second beside depth images and odometry. What is found in a second, from an image's stamp to the
// setpoint that it caused, and the processor's time: that of the vehicle's services, and apart from
// it that of the replay and of listening.
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <thread>

#include "bench/dds/recorded_world.hpp"
#include "bench/dds/stage_delay.hpp"
#include "bench/run_bench.hpp"
#include "foretrack_msgs/msg/PlannedTrajectory.h"
#include "foretrack_msgs/msg/SafetyState.h"
#include "foretrack_msgs/msg/TargetPrediction.h"
#include "foretrack_msgs/msg/TargetState.h"
#include "services/convert/safety.hpp"
#include "services/files/config/load_scenario.hpp"
#include "services/launch/domain.hpp"
#include "services/launch/flight_processes.hpp"
#include "services/launch/launcher.hpp"
#include "services/launch/usage.hpp"
#include "services/operator/order_sender.hpp"

namespace foretrack {
namespace {

namespace fs = std::filesystem;
constexpr double kStart_s = 3.0;   // for the services to start and to find each other
constexpr double kWarmUp_s = 6.0;  // of the replay: load the networks, find the person, start
constexpr double kSameStamp_s = 1e-5;
constexpr std::array kModels = {"lite", "full", "heavy"};

struct Options {
  std::vector<std::string> models = {"lite", "full"};
  std::string scenario = "t_intersection", map = "depth";
  double seconds = 30.0;
  std::uint64_t seed = 5001;
  bool separate = false;
  std::string delays;  // file for every single one
};

// What the vehicle's processes used so far.
std::map<std::string, double> cpu_of(const Launcher& launcher) {
  std::map<std::string, double> used;
  for (const auto& process : launcher.processes())
    if (const auto usage = usage_of(process.pid)) used[process.spec.name] = usage->cpu_s;
  return used;
}

std::vector<ProcessSpec> onboard_of(const Options& o, int domain, const fs::path& params) {
  FlightSpec flight;
  flight.domain = domain;
  flight.map = o.map;
  flight.params_file = params;
  flight.state_folder = params.parent_path() / "gate";
  std::vector<ProcessSpec> processes = onboard_processes(flight);
  for (auto& process : processes) std::erase(process.arguments, "--use-sim-time");
  if (o.separate) return processes;
  ProcessSpec stages = processes.front();  // the others of them in one process, as onboard has it
  stages.name = stages.arguments.front() = "stages";
  if (o.map == "known") stages.arguments.push_back("--no-mapping");
  return {stages, processes.back()};
}

// Hears the loop, and knows of each image when it was taken.
class Ear {
 public:
  Ear(Service& service, const std::vector<RecordedStep>& steps)
      : observation_(service.node()),
        target_(service.node()),
        prediction_(service.node()),
        plan_(service.node()),
        safety_(service.node()) {
    Loop& loop = service.loop();
    const auto answer = [this, &service](StageDelay& stage, const auto& stamp) {
      const double stamp_s = to_seconds(stamp);
      if (is_image(stamp_s)) stage.answered(stamp_s, service.clock().now_s());
    };
    loop.on_each(observation_, [this, answer](const auto& m) {
      const bool found = m.kind() != foretrack_msgs::msg::TargetObservation_Constants::KIND_NONE;
      if (is_image(to_seconds(m.header().stamp()))) ++looked_at_, found_ += found;
      answer(stages_[0], m.header().stamp());
    });
    loop.on_each(target_, [this, answer](const auto& m) {
      answer(stages_[1], m.header().stamp());
      compare(m);
    });
    loop.on_each(prediction_,
                 [this, answer](const auto& m) { answer(stages_[2], m.header().stamp()); });
    loop.on_each(plan_, [this, answer](const auto& m) { answer(stages_[3], m.header().stamp()); });
    loop.on_each(safety_, [this, answer](const auto& m) {
      ++modes_[std::string(to_string(static_cast<SafetyMode>(m.mode())))];
      if (m.setpoint_valid()) answer(stages_[4], m.caused_by());
    });
    for (const auto& step : steps)
      if (step.color) truth_[step.color->stamp_s] = step.out.target.position_enu_m.head<2>();
  }

  // The images' own stamps count from begin_s on.
  void start(double begin_s) { begin_s_ = begin_s; }
  void measure_from(double after_s) {
    for (const auto& [stamp_s, truth] : truth_)
      if (stamp_s >= after_s)
        for (StageDelay& stage : stages_) stage.caused(begin_s_ + stamp_s, begin_s_ + stamp_s);
    from_s_ = begin_s_ + after_s;
    looked_at_ = found_ = 0;
    modes_.clear();
    errors_m_.clear();
  }
  void write_delays(std::ostream& out) const {
    for (const StageDelay& stage : stages_) out << stage.rows();
  }
  void report(double seconds) const {
    fmt::print("images looked at: {:.1f} a second, a person found in {:.1f} %\n",
               looked_at_ / seconds, looked_at_ ? 100.0 * found_ / looked_at_ : 0.0);
    fmt::print("ms of wall time after the image's stamp\n{}", StageDelay::head());
    for (const StageDelay& stage : stages_) fmt::print("{}", stage.row());
    fmt::print("target: {:.3f} m from the truth at the median\n", quantile_of(errors_m_, 0.5));
    for (const auto& [mode, count] : modes_) fmt::print("gate: {} in {} reports\n", mode, count);
  }

 private:
  // A stamp that was coasted to is no image's.
  std::map<double, Vec2>::const_iterator image_of(double stamp_s) const {
    const auto image = truth_.lower_bound(stamp_s - begin_s_ - kSameStamp_s);
    const bool same = image != truth_.end() && image->first < stamp_s - begin_s_ + kSameStamp_s;
    return same && stamp_s > from_s_ - kSameStamp_s ? image : truth_.end();
  }
  bool is_image(double stamp_s) const { return image_of(stamp_s) != truth_.end(); }
  void compare(const foretrack_msgs::msg::TargetState& m) {
    const auto image = image_of(to_seconds(m.header().stamp()));
    if (image == truth_.end()) return;
    errors_m_.push_back((Vec2(m.position_m()[0], m.position_m()[1]) - image->second).norm());
  }

  Reader<topics::TargetObservation> observation_;
  Reader<topics::TargetState> target_;
  Reader<topics::TargetPrediction> prediction_;
  Reader<topics::PlannedTrajectory> plan_;
  Reader<topics::SafetyState> safety_;
  std::array<StageDelay, 5> stages_{StageDelay("landmarks"), StageDelay("target"),
                                    StageDelay("prediction"), StageDelay("plan"),
                                    StageDelay("setpoint")};
  std::map<double, Vec2> truth_;  // where the person was, by the images' stamps in the recording
  std::map<std::string, int> modes_;
  std::vector<double> errors_m_;
  double begin_s_ = 0.0, from_s_ = 1e18;
  int looked_at_ = 0, found_ = 0;
};

void measure(const Options& o, const std::string& model, const Scenario& scenario,
             std::vector<RecordedStep> steps) {
  const FreeDomain domain;
  fmt::print("domain {}\n", domain.id());  // for who wants to listen too
  std::fflush(stdout);
  const fs::path folder = "/tmp/foretrack_camera_loop_bench." + std::to_string(getpid());
  fs::create_directories(folder);
  const auto complexity = std::find(kModels.begin(), kModels.end(), model) - kModels.begin();
  std::ofstream(folder / "params.yaml")
      << fmt::format("perception: {{model_complexity: {}}}\n", complexity);
  Launcher launcher(folder, fs::read_symlink("/proc/self/exe").parent_path() / "foretrack");
  for (auto& process : onboard_of(o, domain.id(), folder / "params.yaml"))
    launcher.add(std::move(process));

  Stop stop;
  ServiceOptions options;
  options.names.vehicle = FlightSpec{}.vehicle;
  options.domain_id = domain.id();
  Service ear_service("camera_loop_bench", options, stop);
  Service source("camera_loop_source", options, stop);
  Ear ear(ear_service, steps);
  Replay replay(source, scenario, steps);
  std::jthread replaying([&] { source.run(); });
  const double launched_s = ear_service.clock().now_s(), begin_s = launched_s + kStart_s;
  ear.start(begin_s);
  replay.start_at(begin_s);
  OrderSender start(ear_service.node(), {.order = MissionOrder::kStart});
  start.insist();
  ear_service.loop().every_wall(0.05, [&] {
    if (ear_service.clock().now_s() > begin_s) start.update();
  });
  std::map<std::string, double> before;
  double from_s = 0.0, own_before_s = 0.0;
  ear_service.loop().every_wall(0.02, [&] {
    for (const auto& line : launcher.poll()) fmt::print("{}\n", line);
    const double now_s = ear_service.clock().now_s();
    if (from_s == 0.0 && now_s > begin_s + kWarmUp_s) {
      from_s = now_s;
      before = cpu_of(launcher);
      own_before_s = usage_of(getpid())->cpu_s;
      ear.measure_from(now_s - begin_s);
    }
    if (replay.is_over()) stop.request();
  });
  ear_service.run();
  const double seconds = ear_service.clock().now_s() - from_s;
  fmt::print("\n{} model, {} map, {:.0f} s\n", model, o.map, seconds);
  ear.report(seconds);
  if (std::ofstream out(o.delays, std::ios::app); out) ear.write_delays(out);
  double sum_s = 0.0;
  for (const auto& [name, cpu_s] : cpu_of(launcher)) {
    sum_s += cpu_s - before[name];
    if (o.separate) fmt::print("{}: {:.1f} %\n", name, 100.0 * (cpu_s - before[name]) / seconds);
  }
  fmt::print("of a core: vehicle {:.1f} %; replay and listening {:.1f} %\n",
             100.0 * sum_s / seconds, 100.0 * (usage_of(getpid())->cpu_s - own_before_s) / seconds);
  launcher.stop();
  fs::remove_all(folder);
}

int run(const Options& o) {
  ScenarioOverrides overrides;
  overrides.seed = o.seed;
  overrides.duration_s = kWarmUp_s + o.seconds;
  overrides.color_images = true;
  overrides.map = o.map == "known" ? MapSource::kKnown : MapSource::kDepth;
  const Scenario scenario = load_scenario(o.scenario, overrides);
  set_up_logging("warning");
  fmt::print("rendering {:.0f} s of {}\n", scenario.duration_s, scenario.name);
  std::fflush(stdout);
  const auto steps = record_world(scenario);
  for (const auto& model : o.models) {
    measure(o, model, scenario, steps);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace foretrack

int main(int argc, char** argv) {
  foretrack::Options o;
  CLI::App app("the onboard loop on recorded camera images, in real time");
  app.add_option("--models", o.models, "lite, full, heavy")
      ->check(CLI::IsMember({"lite", "full", "heavy"}));
  app.add_option("--seconds", o.seconds, "that are measured")->capture_default_str();
  app.add_option("--scenario", o.scenario)->capture_default_str();
  app.add_option("--seed", o.seed)->capture_default_str();
  app.add_option("--map", o.map)->check(CLI::IsMember({"depth", "known"}))->capture_default_str();
  app.add_option("--delays", o.delays, "file to which every single delay is appended");
  app.add_flag("--separate", o.separate, "each service a process, and its processor's time");
  return foretrack::run_bench(app, argc, argv, [&] { return foretrack::run(o); });
}
