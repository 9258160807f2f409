// SPDX-License-Identifier: Apache-2.0
#include "services/operator/demo_flight.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "services/common/loop.hpp"
#include "services/files/config/load_params.hpp"
#include "services/launch/resources.hpp"
#include "services/offline/flight/fly.hpp"
#include "services/offline/flight/write_flight.hpp"
#include "services/operator/diagnose.hpp"
#include "services/operator/order_sender.hpp"
#include "services/operator/summary.hpp"
#include "services/operator/view.hpp"

namespace foretrack {
namespace {

constexpr double kTakePeriod_s = 0.005;
constexpr double kLaunchPeriod_s = 0.05;
constexpr double kDrawPeriod_s = 0.15;
constexpr double kOnboardPatience_s = 10.0;  // for the services' first sign of life
constexpr double kSilence_s = 10.0;          // no truth for so long: the simulator hangs

NodeOptions node_options(const FlightSpec& spec) {
  NodeOptions options;
  options.service = "demo";
  options.names.vehicle = spec.vehicle;
  options.domain_id = spec.domain;
  options.interface = spec.interface;
  options.security = spec.security;
  return options;
}

class DemoFlight {
 public:
  DemoFlight(const DemoOptions& options, Stop& stop)
      : options_(options),
        stop_(stop),
        launcher_(options.folder / "logs"),
        node_(node_options(options.spec)),
        loop_(node_, stop),
        listener_(node_, true),
        start_(node_, {.order = MissionOrder::kStart, .operator_name = "demo"}),
        log_(options.scenario, [this] { return node_.clock().steady_s(); }) {
    start_.insist();
    log_.attach(listener_.hooks);
    options_.spec.state_folder = (options_.folder / "state").string();
    for (auto& process : onboard_processes(options_.spec)) launcher_.add(std::move(process));
    if (options_.station) launcher_.add(*options_.station);
  }

  void fly() {
    begin_s_ = node_.clock().steady_s();
    if (!options_.headless && is_terminal()) screen_ = std::make_unique<Screen>();
    loop_.every_wall(kTakePeriod_s, [this] { listener_.update(); });
    loop_.every_wall(kLaunchPeriod_s, [this] { supervise(); });
    loop_.every_wall(screen_ ? kDrawPeriod_s : 1.0, [this] { show(); });
    loop_.every_wall(1.0, [this] {
      if (simulator_started_s_ < 0.0) return;
      resources_.sample(launcher_);
      findings_ = diagnose(listener_.snapshot());
    });
    loop_.run();
    wall_s_ = elapsed_s() - std::max(0.0, simulator_started_s_);
    screen_.reset();
    launcher_.stop();
  }

  int report();

 private:
  double elapsed_s() const { return node_.clock().steady_s() - begin_s_; }
  void supervise();
  bool onboard_is_ready();
  bool is_over();
  void show();
  FlightSummary summary() const;
  void write(const FlightSummary& summary) const;

  DemoOptions options_;
  Stop& stop_;
  Launcher launcher_;
  mutable Node node_;
  Loop loop_;
  Listener listener_;
  OrderSender start_;  // the vehicle begins by itself
  FlightLog log_;
  ResourceMeter resources_;
  std::unique_ptr<Screen> screen_;
  std::vector<std::string> events_;
  std::vector<Finding> findings_;
  double begin_s_ = 0.0;
  double simulator_started_s_ = -1.0;
  double last_progress_s_ = 0.0;
  std::size_t rows_ = 0;
  double wall_s_ = 0.0;
};

// The simulator starts when the vehicle is ready, and the person waits until it flies.
bool DemoFlight::onboard_is_ready() {
  const FlightSnapshot snapshot = listener_.snapshot();
  const auto& processes = launcher_.processes();
  const bool all = std::all_of(processes.begin(), processes.end(), [&](const Process& process) {
    return !is_onboard(process.spec.name) || snapshot.service(process.spec.name) != nullptr;
  });
  return all || elapsed_s() > kOnboardPatience_s;
}

void DemoFlight::supervise() {
  for (const auto& line : launcher_.poll()) {
    events_.push_back(fmt::format("{:5.1f} s  {}", elapsed_s(), line));
    if (!screen_) fmt::print("{}\n", events_.back());
  }
  if (simulator_started_s_ < 0.0 && onboard_is_ready()) {
    launcher_.add(simulator_process(options_.spec));
    simulator_started_s_ = elapsed_s();
  }
  start_.update();
  if (is_over()) stop_.request();
}

// The simulator ends when the scenario does, however slow this machine is.
bool DemoFlight::is_over() {
  if (launcher_.any_given_up()) return true;
  if (simulator_started_s_ < 0.0) return false;
  if (log_.rows().size() > rows_) {
    rows_ = log_.rows().size();
    last_progress_s_ = elapsed_s();
  }
  return elapsed_s() - std::max(last_progress_s_, simulator_started_s_) > kSilence_s;
}

void DemoFlight::show() {
  const FlightSnapshot snapshot = listener_.snapshot();
  ViewOptions view;
  view.colors = screen_ != nullptr;
  view.elapsed_s = std::max(0.0, log_.rows().empty() ? 0.0 : log_.rows().back().now_s);
  if (!screen_) {
    fmt::print("{}\n", status_line(snapshot, view));
    std::fflush(stdout);
    return;
  }
  std::string text = draw(snapshot, view);
  if (!options_.page.empty()) text += "page       " + options_.page + '\n';
  for (std::size_t i = events_.size() > 4 ? events_.size() - 4 : 0; i < events_.size(); ++i)
    text += events_[i] + '\n';
  screen_->show(text);
}

FlightSummary DemoFlight::summary() const {
  MetricParams params;
  if (!options_.spec.params_file.empty())
    params = metric_params_of(load_params(options_.spec.params_file));
  FlightSummary summary = summarize(log_, params);
  summary.scenario = options_.scenario.name;
  summary.vehicle = options_.spec.vehicle;
  summary.domain = options_.spec.domain;
  summary.wall_s = wall_s_;
  if (!options_.spec.camera)  // images are on the bus without a delay
    summary.camera_delay_ms = 1e3 * options_.scenario.landmark_camera.delay_s;
  summary.folder = options_.folder.string();
  for (const auto& process : launcher_.processes()) {
    const auto& name = process.spec.name;
    auto& of = summary.services[name];
    of.restarts = std::max(0, process.starts - 1);
    if (is_onboard(name)) summary.onboard.restarts += of.restarts;
    const auto use = resources_.by_process().find(name);
    if (use == resources_.by_process().end()) continue;
    of.cpu_percent = use->second.cpu_percent();
    of.memory_bytes = use->second.pss_peak_bytes;
  }
  summary.onboard.cpu_percent = resources_.onboard_cpu_percent();
  summary.onboard.memory_bytes = resources_.onboard_pss_peak_bytes();
  return summary;
}

void DemoFlight::write(const FlightSummary& summary) const {
  const FlightResult flight{.scenario = options_.scenario,
                            .world = world_of(options_.scenario),
                            .rows = log_.rows(),
                            .metrics = summary.metrics,
                            .plan_ms = {}};
  write_flight(flight, MetricParams{}, options_.folder);
  std::ofstream file(options_.folder / "summary.json");
  file << to_json_text(summary);
  if (!file.flush())
    throw std::runtime_error("cannot write " + (options_.folder / "summary.json").string());
  if (log_.rows().size() < 2) return;
  try {
    plot_flight(options_.folder);
  } catch (const std::exception& error) {
    fmt::print("{}\n", error.what());
  }
}

int DemoFlight::report() {
  const FlightSummary of = summary();
  fmt::print("writing {} …\n", options_.folder.string());
  std::fflush(stdout);
  write(of);
  fmt::print("{}\n", to_text(of));
  if (!of.happened())
    fmt::print("The vehicle did not fly. What the doctor says:\n\n{}\n", to_text(findings_));
  else if (of.metrics.collisions > 0)
    fmt::print("The vehicle collided {} times.\n", of.metrics.collisions);
  fmt::print("{}: log.csv metrics.json summary.json flight.png logs/\n", options_.folder.string());
  std::fflush(stdout);
  return of.good() ? 0 : 1;
}

}  // namespace

int fly_demo(const DemoOptions& options) {
  Stop stop;
  SignalStop signals(stop);
  DemoFlight demo(options, stop);
  demo.fly();
  const int status = demo.report();
  return status;
}

}  // namespace foretrack
