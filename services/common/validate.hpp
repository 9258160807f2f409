// What a sample must be before anybody sees it: bounded (IDL bounds are not enforced on receive),
// finite, in range, with a well-formed stamp. Each returns why not, a constant; null: acceptable.
#pragma once

#include "type_name.hpp"

namespace foretrack {

const char* validate(const foretrack_msgs::msg::TargetObservation& m);
const char* validate(const foretrack_msgs::msg::TargetState& m);
const char* validate(const foretrack_msgs::msg::TargetIntention& m);
const char* validate(const foretrack_msgs::msg::TargetPrediction& m);
const char* validate(const foretrack_msgs::msg::LocalMap& m);
const char* validate(const foretrack_msgs::msg::PlannedTrajectory& m);
const char* validate(const foretrack_msgs::msg::SafetyState& m);
const char* validate(const foretrack_msgs::msg::MissionCommand& m);
const char* validate(const foretrack_msgs::msg::ServiceHealth& m);
const char* validate(const nav_msgs::msg::Odometry& m);
const char* validate(const sensor_msgs::msg::Image& m);
const char* validate(const sensor_msgs::msg::CameraInfo& m);
const char* validate(const rosgraph_msgs::msg::Clock& m);
const char* validate(const px4_msgs::msg::VehicleOdometry& m);
const char* validate(const px4_msgs::msg::TrajectorySetpoint& m);

/// Malformed, or more than half a second after now_s (0: now is not known yet).
const char* validate_stamp(const builtin_interfaces::msg::Time& stamp, double now_s);

}  // namespace foretrack
