// SPDX-License-Identifier: Apache-2.0
// Fuzz target: any bytes as a sample of each topic that is converted, through the CDR wrapper. What
// is accepted is used as the services use it.
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "services/common/raw.hpp"
#include "services/convert/bodies.hpp"
#include "services/convert/fleet.hpp"
#include "services/convert/fleet_report.hpp"
#include "services/convert/image.hpp"
#include "services/convert/map.hpp"
#include "services/convert/prediction.hpp"
#include "services/convert/px4.hpp"
#include "services/convert/px4_command.hpp"
#include "services/convert/px4_health.hpp"
#include "services/convert/px4_home.hpp"
#include "services/convert/safety.hpp"
#include "services/convert/target.hpp"
#include "services/convert/trajectory.hpp"
#include "services/convert/vehicle.hpp"

namespace foretrack {
namespace {

// Before the start, in the middle, long after the end.
constexpr double kTimes_s[] = {-1e9, -0.05, 0.0, 0.07, 1.0, 1e9};

template <class Value>
void use(const Value&) {}
void use(const PlannedTrajectory& plan) {
  for (const double t_s : kTimes_s) {
    plan.yaw.at(t_s);
    plan.gimbal_pitch.at(t_s);
    if (!plan.pieces.empty() && !plan.position(t_s).allFinite())
      throw std::logic_error("a plan that is nowhere was accepted");
  }
}
void use(const FleetMember& member) {
  for (const double t_s : kTimes_s)
    if (!member.plan.empty() && !member.plan.position(t_s).allFinite())
      throw std::logic_error("a vehicle that flies nowhere was accepted");
}
void use(const TargetState& state) {
  if (!state.position_enu_m.allFinite()) throw std::logic_error("a person who is nowhere");
}

template <class Message>
void feed(const CdrBytes& bytes) {
  Message message;
  if (!from_cdr(type_ops<Message>(), bytes, &message)) return;
  if (const auto value = from_idl(message)) use(*value);
}

constexpr std::array kFeeds = {
    feed<foretrack_msgs::msg::MovingBodies>,      feed<foretrack_msgs::msg::BodySightings>,
    feed<sensor_msgs::msg::CameraInfo>,           feed<foretrack_msgs::msg::LocalMap>,
    feed<foretrack_msgs::msg::TargetIntention>,   feed<foretrack_msgs::msg::TargetPrediction>,
    feed<px4_msgs::msg::TrajectorySetpoint>,      feed<px4_msgs::msg::VehicleOdometry>,
    feed<px4_msgs::msg::VehicleStatus>,           feed<px4_msgs::msg::VehicleCommand>,
    feed<px4_msgs::msg::BatteryStatus>,           feed<px4_msgs::msg::HomePosition>,
    feed<foretrack_msgs::msg::MissionCommand>,    feed<foretrack_msgs::msg::SafetyState>,
    feed<foretrack_msgs::msg::TargetObservation>, feed<foretrack_msgs::msg::TargetState>,
    feed<foretrack_msgs::msg::PlannedTrajectory>, feed<nav_msgs::msg::Odometry>,
    feed<foretrack_msgs::msg::FleetMember>,       feed<foretrack_msgs::msg::FleetDivision>,
};

}  // namespace
}  // namespace foretrack

// The first byte chooses the type.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  foretrack::kFeeds[data[0] % foretrack::kFeeds.size()](foretrack::CdrBytes(data + 1, data + size));
  return 0;
}
