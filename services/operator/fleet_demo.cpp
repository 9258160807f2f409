// SPDX-License-Identifier: Apache-2.0
#include "services/operator/fleet_demo.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "services/common/loop.hpp"
#include "services/files/config/load_params.hpp"
#include "services/offline/flight/write_fleet.hpp"
#include "services/operator/fleet_log.hpp"
#include "services/operator/view.hpp"

namespace foretrack {
namespace {

constexpr double kTakePeriod_s = 0.005;
constexpr double kLaunchPeriod_s = 0.05;
constexpr double kDrawPeriod_s = 0.25;
constexpr double kOnboardPatience_s = 20.0;  // for the services' first sign of life
constexpr double kSilence_s = 10.0;          // no truth for so long: the simulator hangs

NodeOptions fleet_node_options(const FlightSpec& spec) {
  NodeOptions options;
  options.service = "demo";
  options.names.vehicle = spec.vehicles.front().vehicle;
  options.domain_id = spec.domain;
  options.interface = spec.interface;
  options.security = spec.security;
  return options;
}

class FleetDemo {
 public:
  FleetDemo(const DemoOptions& options, Stop& stop)
      : options_(options),
        stop_(stop),
        launcher_(options.folder / "logs"),
        log_(fleet_node_options(options.spec), options.scenario),
        loop_(*log_.vehicles().front()->node, stop) {
    for (const auto& vehicle : log_.vehicles()) {
      starts_.push_back(std::make_unique<OrderSender>(
          *vehicle->node, MissionCommand{.order = MissionOrder::kStart, .operator_name = "demo"}));
      starts_.back()->insist();
    }
    options_.spec.state_folder = (options_.folder / "state").string();
    for (auto& process : onboard_processes(options_.spec)) launcher_.add(std::move(process));
    if (options_.station) launcher_.add(*options_.station);
  }

  void fly() {
    begin_s_ = now_s();
    if (!options_.headless && is_terminal()) screen_ = std::make_unique<Screen>();
    loop_.every_wall(kTakePeriod_s, [this] { log_.update(); });
    loop_.every_wall(kLaunchPeriod_s, [this] { supervise(); });
    loop_.every_wall(screen_ ? kDrawPeriod_s : 1.0, [this] { show(); });
    loop_.run();
    screen_.reset();
    launcher_.stop();
  }

  int report() const;

 private:
  double now_s() const { return log_.vehicles().front()->node->clock().steady_s(); }
  bool all_are_ready() const;
  void supervise();
  bool is_over();
  void show();

  DemoOptions options_;
  Stop& stop_;
  Launcher launcher_;
  FleetLog log_;
  Loop loop_;
  std::vector<std::unique_ptr<OrderSender>> starts_;  // vehicles begin by themselves
  std::unique_ptr<Screen> screen_;
  std::vector<std::string> events_;
  double begin_s_ = 0.0, simulator_started_s_ = -1.0, last_progress_s_ = 0.0;
  std::size_t rows_ = 0;
};

bool FleetDemo::all_are_ready() const {
  const auto is_ready = [](const auto& vehicle) {
    const FlightSnapshot heard = vehicle->listener->snapshot();
    return heard.service("planning") && heard.service("safety_gate");
  };
  return std::all_of(log_.vehicles().begin(), log_.vehicles().end(), is_ready) ||
         now_s() - begin_s_ > kOnboardPatience_s;
}

void FleetDemo::supervise() {
  for (const auto& line : launcher_.poll()) {
    events_.push_back(fmt::format("{:5.1f} s  {}", now_s() - begin_s_, line));
    if (!screen_) fmt::print("{}\n", events_.back());
  }
  if (simulator_started_s_ < 0.0 && all_are_ready()) {
    launcher_.add(simulator_process(options_.spec));
    simulator_started_s_ = now_s();
  }
  for (const auto& start : starts_) start->update();
  if (is_over()) stop_.request();
}

// The simulator ends when the scenario does, however slow this machine is.
bool FleetDemo::is_over() {
  if (launcher_.any_given_up()) return true;
  if (simulator_started_s_ < 0.0) return false;
  if (log_.rows().size() > rows_) {
    rows_ = log_.rows().size();
    last_progress_s_ = now_s();
  }
  return now_s() - std::max(last_progress_s_, simulator_started_s_) > kSilence_s;
}

void FleetDemo::show() {
  std::string text;
  for (const auto& vehicle : log_.vehicles()) {
    const FlightSnapshot heard = vehicle->listener->snapshot();
    ViewOptions view;
    view.colors = screen_ != nullptr;
    if (!vehicle->log->rows().empty()) view.elapsed_s = vehicle->log->rows().back().now_s;
    text += fmt::format("{:<8}{}\n", vehicle->name, status_line(heard, view));
  }
  if (!screen_) {
    fmt::print("{}", text);
    std::fflush(stdout);
    return;
  }
  if (!options_.page.empty()) text += "page    " + options_.page + '\n';
  for (std::size_t i = events_.size() > 4 ? events_.size() - 4 : 0; i < events_.size(); ++i)
    text += events_[i] + '\n';
  screen_->show(text);
}

int FleetDemo::report() const {
  TrackerParams params;
  if (!options_.spec.params_file.empty()) params = load_params(options_.spec.params_file);
  const MetricParams metrics = metric_params_of(params);
  const FleetFlight flight = log_.flight(metrics, params.fleet);
  write_fleet_flight(flight, metrics, options_.folder);
  fmt::print("{}{}: metrics.json, logs/, a folder of each vehicle\n", to_text(flight),
             options_.folder.string());
  std::fflush(stdout);
  bool good = flight.metrics.contacts == 0;
  for (std::size_t i = 0; i < flight.names.size(); ++i) {
    const bool flew = log_.vehicles()[i]->log->path_length_m() > 0.5;
    if (!flew) fmt::print("{0} did not fly: foretrack doctor --vehicle {0}\n", flight.names[i]);
    good = good && flew && flight.vehicles[i].metrics.collisions == 0;
  }
  return good ? 0 : 1;
}

}  // namespace

int fly_fleet_demo(const DemoOptions& options) {
  Stop stop;
  SignalStop signals(stop);
  FleetDemo demo(options, stop);
  demo.fly();
  return demo.report();
}

}  // namespace foretrack
