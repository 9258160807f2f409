// SPDX-License-Identifier: Apache-2.0
#include "services/simulator/world_writer.hpp"

#include "services/convert/px4.hpp"
#include "services/convert/px4_health.hpp"
#include "services/convert/transforms.hpp"
#include "services/convert/vehicle.hpp"

namespace foretrack {
namespace {

constexpr int kStatusSteps = 20;  // 5 Hz, and at each change
constexpr int kFlagsSteps = 50;   // 2 Hz, and at each change
constexpr int kBatterySteps = 100;
constexpr int kTruthSteps = 2;  // 50 Hz
constexpr int kPositionSteps = 2;

bool same(const AutopilotStatus& a, const AutopilotStatus& b) {
  return a.armed == b.armed && a.mode == b.mode && a.failsafe == b.failsafe &&
         a.user_took_over == b.user_took_over;
}

}  // namespace

WorldWriter::WorldWriter(Node& node, const Scenario& scenario, const World& world)
    : scene_(node, scenario),
      odometry_(node),
      px4_odometry_(node),
      px4_position_(node),
      px4_status_(node),
      px4_battery_(node),
      px4_home_(node),
      px4_flags_(node),
      px4_sticks_(node),
      transforms_(node) {
  scene_.publish_map(scenario, world);
}

void WorldWriter::publish(const SimulatorOutput& out) {
  ++steps_;
  publish_vehicle(out);
  publish_autopilot(out);
  scene_.publish_cameras(out);
  if (every(kTruthSteps)) scene_.publish_truth(out);
}

void WorldWriter::publish_vehicle(const SimulatorOutput& out) {
  to_idl(out.vehicle, odometry_.sample(), scene_.body_frame());
  odometry_.write();
  to_idl(out.vehicle, px4_odometry_.sample());
  px4_odometry_.write();
  if (!every(kPositionSteps)) return;
  to_idl(out.vehicle, px4_position_.sample());
  set_origin(kOriginOfWorlds, px4_position_.sample());
  px4_position_.write();
  if (transforms_.readers() == 0) return;
  to_transform(out.vehicle, scene_.body_frame(), transforms_.sample());
  transforms_.write();
}

void WorldWriter::publish_autopilot(const SimulatorOutput& out) {
  if (every(kBatterySteps)) {
    to_idl(out.battery.state(), out.now_s, px4_battery_.sample());
    px4_battery_.write();
    to_idl(kOriginOfWorlds, out.home_enu_m, out.now_s, px4_home_.sample());
    px4_home_.write();
  }
  const bool news = out.offboard_possible != offboard_possible_ || out.trouble != trouble_;
  if (news || every(kFlagsSteps)) {
    offboard_possible_ = out.offboard_possible;
    trouble_ = out.trouble;
    to_flags(out.now_s, out.offboard_possible, out.battery.state().warning, out.trouble,
             px4_flags_.sample());
    px4_flags_.write();
  }
  if (out.autopilot.sticks_moved) {
    px4_sticks_.sample().timestamp(static_cast<std::uint64_t>(1e6 * out.now_s));
    px4_sticks_.sample().valid(true);
    px4_sticks_.sample().sticks_moving(true);
    px4_sticks_.write();
  }
  if (same(out.autopilot, autopilot_) && !every(kStatusSteps)) return;
  autopilot_ = out.autopilot;
  to_idl(out.autopilot, px4_status_.sample());
  px4_status_.write();
}

}  // namespace foretrack
