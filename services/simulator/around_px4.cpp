// SPDX-License-Identifier: Apache-2.0
#include "services/simulator/around_px4.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/simulator/place_scenario.hpp"
#include "services/common/find_px4.hpp"
#include "services/convert/geometry.hpp"
#include "services/convert/px4.hpp"
#include "services/convert/px4_mode.hpp"

namespace foretrack {
namespace {

constexpr double kStep_s = 0.01;
constexpr double kGap_s = 1.0;  // of the odometry: meanwhile nobody moved
constexpr int kTruthSteps = 2;
constexpr double kForEver_s = 1e18;

// Offboard mode, or a mode that was registered, which is ours: nobody else is there.
bool is_flown_by_us(const px4_msgs::msg::VehicleStatus& status) {
  namespace constants = px4_msgs::msg::VehicleStatus_Constants;
  const bool armed = status.arming_state() == constants::ARMING_STATE_ARMED;
  return armed && (status.nav_state() == constants::NAVIGATION_STATE_OFFBOARD ||
                   status.nav_state() >= kFirstMode);
}

}  // namespace

AroundPx4::AroundPx4(Service& service, const Scenario& scenario, const SimulatorOptions& options,
                     Stop& stop)
    : stop_(stop),
      scenario_(scenario),
      options_(options),
      odometry_(service.node()),
      status_(service.node()),
      clock_(service.node()),
      scene_(service.node(), scenario) {
  if (!scenario.vehicles.empty())
    throw std::invalid_argument("--px4 flies one vehicle, and the scenario has " +
                                std::to_string(scenario.vehicles.size()));
  make_simulator(scenario, options.person, options.bystanders);  // throws what must be corrected
  service.loop().on_newest(status_, [this](const px4_msgs::msg::VehicleStatus& status) {
    flies_ = is_flown_by_us(status);
  });
  service.loop().on_each(
      odometry_, [](const px4_msgs::msg::VehicleOdometry& message) { return from_idl(message); },
      [this](const VehicleState& vehicle) { hear(vehicle); });
}

void AroundPx4::hear(const VehicleState& vehicle) {
  if (!state_) return begin(vehicle);
  const double passed_s = vehicle.stamp_s - state_->output.now_s;
  if (passed_s < -kGap_s) {
    spdlog::warn("simulator: PX4 was started anew, and so is the scenario");
    return begin(vehicle);
  }
  if (passed_s > kGap_s) {
    spdlog::warn("simulator: no odometry for {:.1f} s", passed_s);
    begin_at(*state_, passed_s - kStep_s);
    people_set_off_s_ += passed_s - kStep_s;
  }
  if (vehicle.stamp_s > state_->output.now_s) step(vehicle);
}

void AroundPx4::begin(const VehicleState& vehicle) try {
  state_ = make_simulator(scenario_, options_.person, options_.bystanders);
  place_scenario(*state_, vehicle);
  begin_at(*state_, vehicle.stamp_s);
  begun_s_ = people_set_off_s_ = vehicle.stamp_s;
  people_wait_ = options_.people_wait_s > 0.0;
  scene_.publish_map(scenario_, state_->world);
  spdlog::info("simulator: PX4's vehicle is there, at {:.1f} s of its time", vehicle.stamp_s);
} catch (const std::invalid_argument& error) {
  spdlog::error("simulator: {}", error.what());
  stop_.request();
}

// In steps of about 10 ms, of which the last one is at the odometry's stamp.
void AroundPx4::step(VehicleState vehicle) {
  const double end_s = vehicle.stamp_s, begin_s = state_->output.now_s;
  people_wait_ = people_wait_ && !flies_ && begin_s - begun_s_ < options_.people_wait_s;
  if (people_wait_) people_set_off_s_ = end_s;
  state_->people_wait = people_wait_;
  const int count = std::max(1, static_cast<int>(std::lround((end_s - begin_s) / kStep_s)));
  for (int i = 1; i <= count; ++i) {
    vehicle.stamp_s = begin_s + (end_s - begin_s) * i / count;
    simulate_around(*state_, vehicle);
    tell();
  }
  const bool over = end_s >= people_set_off_s_ + scenario_.duration_s;
  if (!options_.endless && over) stop_.request();
}

void AroundPx4::tell() {
  const SimulatorOutput& out = state_->output;
  scene_.publish_cameras(out);
  if (++steps_ % kTruthSteps == 0) scene_.publish_truth(out);
  clock_.sample().clock(to_time(out.now_s));
  clock_.write();
}

void run_around_px4(const ServiceOptions& options, const Scenario& scenario,
                    const SimulatorOptions& simulator, Stop& stop) {
  ServiceOptions own = options;
  own.use_sim_time = false;  // it is the clock
  if (own.names.px4_release.empty()) {
    spdlog::info("simulator: waits for PX4");
    own.names.px4_release = find_px4_release(node_options("simulator", own), kForEver_s, stop);
    if (stop.requested()) return;
  }
  Service service("simulator", own, stop);
  AroundPx4 stage(service, scenario, simulator, stop);
  service.run();
}

}  // namespace foretrack
