// SPDX-License-Identifier: Apache-2.0
#include "services/simulator/simulator_service.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/simulator/fleet_failures.hpp"
#include "core/simulator/fleet_starts.hpp"
#include "services/convert/geometry.hpp"

namespace foretrack {
namespace {

constexpr double kStep_s = 0.01;
constexpr double kMostBehind = 5.0;  // steps that are made up for

double checked_speed(double speed) {
  if (speed >= 0.01 && speed <= 100.0) return speed;
  throw std::invalid_argument("speed " + std::to_string(speed) + ": 0.01 to 100 expected");
}

void take_names_of(const Scenario& scenario, std::size_t vehicle, Names& names) {
  names.vehicle = scenario.vehicles[vehicle].name;
  names.px4_namespace = px4_namespace_of(vehicle);
}

}  // namespace

SimulatorService::SimulatorService(Service& service, const Scenario& scenario,
                                   const SimulatorOptions& options, Stop& stop)
    : clock_of_pace_(service.clock()),
      stop_(stop),
      options_(options),
      scenario_(scenario),
      people_wait_(options.people_wait_s > 0.0),
      clock_(service.node()) {
  period_s_ = kStep_s / checked_speed(options.speed);
  if (scenario.vehicles.empty())
    vehicles_.push_back(std::make_unique<SimulatedVehicle>(
        service.node(), make_simulator(scenario, options.person, options.bystanders)));
  else
    add_vehicles(service);
  service.loop().every_wall(period_s_, [this] { keep_pace(); });
}

void SimulatorService::add_vehicles(Service& service) {
  const World world = world_of(scenario_);
  const Person person =
      make_person(scenario_.target.person, walk_of(scenario_, world), world.min_m.z());
  const std::vector<Vec3> starts = fleet_starts(scenario_, world, person);
  presences_.resize(starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    Scenario one = scenario_of(scenario_, i, starts[i], person);
    one.autopilot.system_id = px4_system_of(i);
    NodeOptions options = service.node().options();
    take_names_of(scenario_, i, options.names);
    if (i > 0) nodes_.push_back(std::make_unique<Node>(options));
    vehicles_.push_back(std::make_unique<SimulatedVehicle>(
        i > 0 ? *nodes_.back() : service.node(),
        make_simulator(one, options_.person, options_.bystanders)));
  }
}

// A rendered image takes longer than a step: the next steps make up for it, two at a time.
void SimulatorService::keep_pace() {
  const double now_s = clock_of_pace_.steady_s();
  due_s_ = std::max(due_s_ + period_s_, now_s - kMostBehind * period_s_);
  step();
  if (now_s - due_s_ < period_s_) return;
  due_s_ += period_s_;
  step();
}

bool SimulatorService::people_wait() const {
  const bool all_fly = std::all_of(vehicles_.begin(), vehicles_.end(),
                                   [](const auto& vehicle) { return vehicle->flies_offboard(); });
  return people_wait_ && !all_fly && now_s_ < options_.people_wait_s;
}

bool SimulatorService::is_there(std::size_t vehicle) const {
  return scenario_.vehicles.empty() || presences_[vehicle].is_there();
}

void SimulatorService::step() {
  people_wait_ = people_wait();
  if (people_wait_) people_set_off_s_ = now_s_;
  for (std::size_t i = 0; i < vehicles_.size(); ++i) step(i);
  now_s_ += kStep_s;
  clock_.sample().clock(to_time(vehicles_.front()->output().now_s));
  clock_.write();
  if (!options_.endless && now_s_ >= people_set_off_s_ + scenario_.duration_s) stop_.request();
}

// Who has died, or has yet to join, is silent, and nobody sees it.
void SimulatorService::step(std::size_t vehicle) {
  SimulatorState& state = vehicles_[vehicle]->state();
  state.people_wait = people_wait_;
  state.peers_enu_m.clear();
  for (std::size_t i = 0; i < vehicles_.size(); ++i)
    if (i != vehicle && is_there(i))
      state.peers_enu_m.push_back(vehicles_[i]->state().quadrotor.vehicle.position_enu_m);
  if (!scenario_.vehicles.empty()) {
    const std::string& name = scenario_.vehicles[vehicle].name;
    const double since_s = now_s_ - people_set_off_s_;
    state.blind = since_s >= failure_s(scenario_, name, FleetFailureKind::kBlind);
    presences_[vehicle].update(scenario_, name, since_s, state.quadrotor.vehicle.position_enu_m,
                               state.person.state.position_enu_m, state.peers_enu_m);
  }
  vehicles_[vehicle]->step(kStep_s, is_there(vehicle));
}

void run_simulator(const ServiceOptions& options, const Scenario& scenario,
                   const SimulatorOptions& simulator, Stop& stop) {
  ServiceOptions own = options;
  own.use_sim_time = false;  // it is the clock
  if (!scenario.vehicles.empty()) take_names_of(scenario, 0, own.names);
  Service service("simulator", own, stop);
  SimulatorService stage(service, scenario, simulator, stop);
  service.run();
}

}  // namespace foretrack
