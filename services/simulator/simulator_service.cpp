#include "services/simulator/simulator_service.hpp"

#include <stdexcept>

#include "services/convert/geometry.hpp"
#include "services/convert/image.hpp"
#include "services/convert/map.hpp"
#include "services/convert/px4.hpp"
#include "services/convert/px4_health.hpp"
#include "services/convert/target.hpp"
#include "services/convert/vehicle.hpp"

namespace foretrack {
namespace {

constexpr double kStep_s = 0.01;
constexpr int kStatusSteps = 20;  // 5 Hz, and at each change
constexpr int kFlagsSteps = 50;   // 2 Hz, and at each change
constexpr int kBatterySteps = 100;
constexpr int kTruthSteps = 2;  // 50 Hz
constexpr int kPositionSteps = 2;

double checked_speed(double speed) {
  if (speed >= 0.01 && speed <= 100.0) return speed;
  throw std::invalid_argument("speed " + std::to_string(speed) + ": 0.01 to 100 expected");
}

bool same(const AutopilotStatus& a, const AutopilotStatus& b) {
  return a.armed == b.armed && a.offboard == b.offboard && a.failsafe == b.failsafe;
}

VehicleState as_odometry(const PersonState& person) {
  return {.stamp_s = person.stamp_s,
          .position_enu_m = person.position_enu_m,
          .velocity_enu_m_s = person.velocity_enu_m_s,
          .q_world_body = Quat(Eigen::AngleAxisd(person.body_yaw_rad, Vec3::UnitZ()))};
}

}  // namespace

SimulatorService::SimulatorService(Service& service, const Scenario& scenario,
                                   const SimulatorOptions& options, Stop& stop)
    : node_(service.node()),
      stop_(stop),
      options_(options),
      state_(make_simulator(scenario, options.person)),
      heartbeat_(node_),
      setpoint_(node_),
      command_(node_),
      clock_(node_),
      odometry_(node_),
      px4_odometry_(node_),
      px4_position_(node_),
      px4_status_(node_),
      px4_battery_(node_),
      px4_flags_(node_),
      depth_(node_),
      camera_info_(node_),
      color_(node_),
      color_info_(node_),
      target_truth_(node_),
      vehicle_truth_(node_),
      transforms_(node_),
      mount_(node_),
      map_(node_) {
  if (!scenario.color_images) observation_.emplace(node_);
  publish_latched();
  service.loop().every_wall(kStep_s / checked_speed(options.speed), [this] { step(); });
}

void SimulatorService::publish_latched() {
  const Scenario& scenario = state_.scenario;
  to_transform(scenario.depth_camera.camera.T_body_camera, 0.0, mount_.sample());
  mount_.write();
  if (scenario.map != MapSource::kKnown) return;
  to_idl(known_map(state_.world, scenario.map_resolution_m), map_.sample());
  map_.write();
}

void SimulatorService::step() {
  const SimulatorOutput& out = simulate(state_, take_input(), kStep_s);
  ++steps_;
  publish_vehicle(out);
  publish_autopilot(out);
  publish_cameras(out);
  if (every(kTruthSteps)) publish_truth(out);
  clock_.sample().clock(to_time(out.now_s));
  clock_.write();
  if (!options_.endless && out.now_s >= state_.scenario.duration_s) stop_.request();
}

AutopilotInput SimulatorService::take_input() {
  AutopilotInput input;
  input.heartbeat = heartbeat_.take_newest() != nullptr;
  input.setpoint = setpoint_.take_newest_as(
      [](const px4_msgs::msg::TrajectorySetpoint& message) { return from_idl(message); });
  take_commands(input);
  return input;
}

void SimulatorService::take_commands(AutopilotInput& input) {
  command_.take_each_as(
      [](const px4_msgs::msg::VehicleCommand& message) { return from_idl(message); },
      [&input](AutopilotRequest request) {
        if (request == AutopilotRequest::kArm) input.arm = true;
        if (request == AutopilotRequest::kOffboard) input.mode = AutopilotMode::kOffboard;
        if (request == AutopilotRequest::kReturn) input.mode = AutopilotMode::kReturn;
        if (request == AutopilotRequest::kLand) input.mode = AutopilotMode::kLand;
      });
}

void SimulatorService::publish_vehicle(const SimulatorOutput& out) {
  to_idl(out.vehicle, odometry_.sample());
  odometry_.write();
  to_idl(out.vehicle, px4_odometry_.sample());
  px4_odometry_.write();
  if (!every(kPositionSteps)) return;
  to_idl(out.vehicle, px4_position_.sample());
  px4_position_.write();
  if (transforms_.readers() == 0) return;
  to_transform(out.vehicle, transforms_.sample());
  transforms_.write();
}

void SimulatorService::publish_autopilot(const SimulatorOutput& out) {
  if (every(kBatterySteps)) {
    to_idl(out.battery.state(), out.now_s, px4_battery_.sample());
    px4_battery_.write();
  }
  if (out.offboard_possible != offboard_possible_ || every(kFlagsSteps)) {
    offboard_possible_ = out.offboard_possible;
    to_flags(out.now_s, out.offboard_possible, out.battery.state().warning, px4_flags_.sample());
    px4_flags_.write();
  }
  if (same(out.autopilot, autopilot_) && !every(kStatusSteps)) return;
  autopilot_ = out.autopilot;
  to_idl(out.autopilot, px4_status_.sample());
  px4_status_.write();
}

void SimulatorService::publish_cameras(const SimulatorOutput& out) {
  if (out.observation) {
    to_idl(*out.observation, observation_->sample());
    observation_->write();
  }
  if (out.color) {
    to_idl(out.color->camera, out.color->stamp_s, color_info_.sample());
    color_info_.write();
    to_idl(out.color->pixels, out.color->stamp_s, color_.sample());
    color_.write();
  }
  if (!out.depth) return;
  to_idl(out.depth->camera, out.depth->stamp_s, camera_info_.sample());
  camera_info_.write();
  to_idl(*out.depth, depth_.sample());
  depth_.write();
}

void SimulatorService::publish_truth(const SimulatorOutput& out) {
  to_idl(as_odometry(out.target), target_truth_.sample());
  target_truth_.write();
  to_idl(out.vehicle, vehicle_truth_.sample());
  vehicle_truth_.write();
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
