// SPDX-License-Identifier: Apache-2.0
#include "services/simulator/simulator_service.hpp"

#include <algorithm>
#include <stdexcept>

#include "services/convert/geometry.hpp"
#include "services/convert/px4.hpp"
#include "services/convert/px4_command.hpp"

namespace foretrack {
namespace {

constexpr double kStep_s = 0.01;
constexpr std::size_t kMaxCommands = 16;
constexpr double kMostBehind = 5.0;  // steps that are made up for

double checked_speed(double speed) {
  if (speed >= 0.01 && speed <= 100.0) return speed;
  throw std::invalid_argument("speed " + std::to_string(speed) + ": 0.01 to 100 expected");
}

}  // namespace

SimulatorService::SimulatorService(Service& service, const Scenario& scenario,
                                   const SimulatorOptions& options, Stop& stop)
    : clock_of_pace_(service.clock()),
      stop_(stop),
      options_(options),
      state_(make_simulator(scenario, options.person, options.bystanders)),
      heartbeat_(service.node()),
      setpoint_(service.node()),
      command_(service.node()),
      ack_(service.node()),
      clock_(service.node()),
      world_(service.node(), scenario, state_.world) {
  state_.people_wait = options.people_wait_s > 0.0;
  period_s_ = kStep_s / checked_speed(options.speed);
  service.loop().every_wall(period_s_, [this] { keep_pace(); });
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
  const SimulatorOutput& out = state_.output;
  const bool flies = out.autopilot.armed && out.autopilot.mode == FlightMode::kOffboard;
  return state_.people_wait && !flies && out.now_s < options_.people_wait_s;
}

void SimulatorService::step() {
  state_.people_wait = people_wait();
  if (state_.people_wait) people_set_off_s_ = state_.output.now_s;
  const SimulatorOutput& out = simulate(state_, take_input(), kStep_s);
  if (out.answer) answer(*out.answer);
  if (!commands_.empty()) commands_.pop_front();
  world_.publish(out);
  clock_.sample().clock(to_time(out.now_s));
  clock_.write();
  if (!options_.endless && out.now_s >= people_set_off_s_ + state_.scenario.duration_s)
    stop_.request();
}

void SimulatorService::answer(CommandResult result) {
  to_ack(commands_.front(), result, state_.output.now_s, ack_.sample());
  ack_.write();
}

AutopilotInput SimulatorService::take_input() {
  AutopilotInput input;
  input.heartbeat = heartbeat_.take_newest() != nullptr;
  input.setpoint = setpoint_.take_newest_as(
      [](const px4_msgs::msg::TrajectorySetpoint& message) { return from_idl(message); });
  input.command = take_command();
  return input;
}

// One a step, in the order of their arrival; others wait.
std::optional<AutopilotCommand> SimulatorService::take_command() {
  command_.take_each([this](const px4_msgs::msg::VehicleCommand& message) {
    if (commands_.size() < kMaxCommands) commands_.push_back(message);
  });
  if (commands_.empty()) return std::nullopt;
  const auto command = from_idl(commands_.front());
  if (command) return *command;
  command_.refuse(command.fault());
  if (commands_.front().target_system() == state_.autopilot.status.system_id)
    answer(CommandResult::kUnsupported);
  return std::nullopt;
}

void run_simulator(const ServiceOptions& options, const Scenario& scenario,
                   const SimulatorOptions& simulator, Stop& stop) {
  ServiceOptions own = options;
  own.use_sim_time = false;  // it is the clock
  Service service("simulator", own, stop);
  SimulatorService stage(service, scenario, simulator, stop);
  service.run();
}

}  // namespace foretrack
