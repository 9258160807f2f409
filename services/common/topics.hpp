// SPDX-License-Identifier: Apache-2.0
// Every topic: its type, its name and its quality of service. Nobody else spells a topic string.
#pragma once

#include <string_view>
#include <tuple>

#include "services/common/names.hpp"
#include "type_name.hpp"

namespace foretrack::topics {

using enum Role;

// camera and vehicle
struct TargetObservation {
  using Type = foretrack_msgs::msg::TargetObservation;
  static constexpr TopicInfo info{"target/observation", Scope::kVehicle, "sensor",
                                  kVehicle | kFrontEnd | kSimulator};
};
struct DepthImage {
  using Type = sensor_msgs::msg::Image;
  static constexpr TopicInfo info{"camera/depth/image", Scope::kVehicle, "image",
                                  kFrontEnd | kSimulator, true};
};
struct DepthCameraInfo {
  using Type = sensor_msgs::msg::CameraInfo;
  static constexpr TopicInfo info{"camera/depth/camera_info", Scope::kVehicle, "sensor",
                                  kFrontEnd | kSimulator};
};
struct ColorImage {
  using Type = sensor_msgs::msg::Image;
  static constexpr TopicInfo info{"camera/color/image", Scope::kVehicle, "image",
                                  kFrontEnd | kSimulator, true};
};
struct ColorImageCompressed {
  using Type = sensor_msgs::msg::CompressedImage;
  static constexpr TopicInfo info{"camera/color/image/compressed", Scope::kVehicle, "image",
                                  kFrontEnd | kSimulator, true};
};
struct ColorCameraInfo {
  using Type = sensor_msgs::msg::CameraInfo;
  static constexpr TopicInfo info{"camera/color/camera_info", Scope::kVehicle, "sensor",
                                  kFrontEnd | kSimulator};
};
struct Odometry {
  using Type = nav_msgs::msg::Odometry;
  static constexpr TopicInfo info{"odometry", Scope::kVehicle, "state",
                                  kFrontEnd | kGate | kSimulator, true};
};
struct Clock {
  using Type = rosgraph_msgs::msg::Clock;
  static constexpr TopicInfo info{"clock", Scope::kClock, "sensor", kSimulator};
};

// what the stages say
struct TargetState {
  using Type = foretrack_msgs::msg::TargetState;
  static constexpr TopicInfo info{"target/state", Scope::kVehicle, "state", kVehicle};
};
struct LocalMap {
  using Type = foretrack_msgs::msg::LocalMap;
  static constexpr TopicInfo info{"map/local", Scope::kVehicle, "map", kVehicle | kSimulator};
};
struct OctoMap {
  using Type = octomap_msgs::msg::Octomap;
  static constexpr TopicInfo info{"map/octomap", Scope::kVehicle, "map", kVehicle};
};
struct MapPoints {
  using Type = sensor_msgs::msg::PointCloud2;
  static constexpr TopicInfo info{"map/points", Scope::kVehicle, "map", kVehicle};
};
struct TargetIntention {
  using Type = foretrack_msgs::msg::TargetIntention;
  static constexpr TopicInfo info{"target/intention", Scope::kVehicle, "state", kVehicle};
};
struct TargetPrediction {
  using Type = foretrack_msgs::msg::TargetPrediction;
  static constexpr TopicInfo info{"target/prediction", Scope::kVehicle, "state", kVehicle};
};
struct PlannedTrajectory {
  using Type = foretrack_msgs::msg::PlannedTrajectory;
  static constexpr TopicInfo info{"plan/trajectory", Scope::kVehicle, "state", kVehicle};
};
struct TargetSearch {
  using Type = foretrack_msgs::msg::TargetSearch;
  static constexpr TopicInfo info{"target/search", Scope::kVehicle, "state", kVehicle};
};
struct SafetyState {
  using Type = foretrack_msgs::msg::SafetyState;
  static constexpr TopicInfo info{"safety/state", Scope::kVehicle, "state", kGate};
};
struct MissionCommand {
  using Type = foretrack_msgs::msg::MissionCommand;
  static constexpr TopicInfo info{"mission/command", Scope::kVehicle, "command", kOperator};
};
struct ServiceHealth {
  using Type = foretrack_msgs::msg::ServiceHealth;
  static constexpr TopicInfo info{"health", Scope::kVehicle, "state",
                                  kVehicle | kGate | kSimulator};
};

// who and what moves around the vehicle
struct BodySightings {
  using Type = foretrack_msgs::msg::BodySightings;
  static constexpr TopicInfo info{"bodies/sightings", Scope::kVehicle, "sensor",
                                  kVehicle | kFrontEnd | kSimulator};
};
struct MovingBodies {
  using Type = foretrack_msgs::msg::MovingBodies;
  static constexpr TopicInfo info{"bodies", Scope::kVehicle, "state", kVehicle};
};

struct TargetChoice {
  using Type = foretrack_msgs::msg::TargetChoice;
  static constexpr TopicInfo info{"target/choice", Scope::kVehicle, "state", kVehicle};
};

// the picture for the ground
struct GroundImage {
  using Type = sensor_msgs::msg::CompressedImage;
  static constexpr TopicInfo info{"camera/ground/image/compressed", Scope::kVehicle, "image",
                                  kVehicle};
};
struct GroundVideo {
  using Type = foxglove_msgs::msg::CompressedVideo;
  static constexpr TopicInfo info{"camera/ground/video", Scope::kVehicle, "image", kVehicle};
};
struct GroundCameraInfo {
  using Type = sensor_msgs::msg::CameraInfo;
  static constexpr TopicInfo info{"camera/ground/camera_info", Scope::kVehicle, "sensor", kVehicle};
};

// what the vehicles of a fleet tell each other, and what each makes of it
struct FleetMember {
  using Type = foretrack_msgs::msg::FleetMember;
  static constexpr TopicInfo info{"fleet/member", Scope::kShared, "sensor", kVehicle};
};
struct FleetDivision {
  using Type = foretrack_msgs::msg::FleetDivision;
  static constexpr TopicInfo info{"fleet/division", Scope::kVehicle, "state", kVehicle};
};
struct FleetBodies {
  using Type = foretrack_msgs::msg::MovingBodies;
  static constexpr TopicInfo info{"fleet/bodies", Scope::kVehicle, "state", kVehicle};
};
struct FleetTarget {
  using Type = foretrack_msgs::msg::TargetState;
  static constexpr TopicInfo info{"fleet/target", Scope::kVehicle, "state", kVehicle};
};

// the same for ROS 2's own tools
struct PredictionPath {
  using Type = nav_msgs::msg::Path;
  static constexpr TopicInfo info{"target/prediction/path", Scope::kVehicle, "state", kVehicle};
};
struct PlanPath {
  using Type = nav_msgs::msg::Path;
  static constexpr TopicInfo info{"plan/path", Scope::kVehicle, "state", kVehicle};
};
struct Markers {
  using Type = visualization_msgs::msg::MarkerArray;
  static constexpr TopicInfo info{"markers", Scope::kVehicle, "state", kVehicle};
};
struct Transforms {
  using Type = tf2_msgs::msg::TFMessage;
  static constexpr TopicInfo info{"tf", Scope::kShared, "state", kGate | kFrontEnd | kSimulator};
};
struct StaticTransforms {
  using Type = tf2_msgs::msg::TFMessage;
  static constexpr TopicInfo info{"tf_static", Scope::kShared, "latched", kFrontEnd | kSimulator};
};
struct Diagnostics {
  using Type = diagnostic_msgs::msg::DiagnosticArray;
  static constexpr TopicInfo info{"diagnostics", Scope::kShared, "state",
                                  kVehicle | kGate | kSimulator};
};

// the simulator's truth, for scoring only
struct TargetTruth {
  using Type = nav_msgs::msg::Odometry;
  static constexpr TopicInfo info{"simulator/target", Scope::kVehicle, "state", kSimulator};
};
struct VehicleTruth {
  using Type = nav_msgs::msg::Odometry;
  static constexpr TopicInfo info{"simulator/vehicle", Scope::kVehicle, "state", kSimulator};
};

// PX4's flight interface
struct Px4VehicleOdometry {
  using Type = px4_msgs::msg::VehicleOdometry;
  static constexpr TopicInfo info{"fmu/out/vehicle_odometry", Scope::kPx4, "sensor",
                                  kAutopilot | kSimulator};
};
struct Px4VehicleStatus {
  using Type = px4_msgs::msg::VehicleStatus;
  static constexpr TopicInfo info{"fmu/out/vehicle_status", Scope::kPx4, "sensor",
                                  kAutopilot | kSimulator};
};
struct Px4VehicleLocalPosition {
  using Type = px4_msgs::msg::VehicleLocalPosition;
  static constexpr TopicInfo info{"fmu/out/vehicle_local_position", Scope::kPx4, "sensor",
                                  kAutopilot | kSimulator};
};
struct Px4VehicleControlMode {
  using Type = px4_msgs::msg::VehicleControlMode;
  static constexpr TopicInfo info{"fmu/out/vehicle_control_mode", Scope::kPx4, "sensor",
                                  kAutopilot | kSimulator};
};
struct Px4BatteryStatus {
  using Type = px4_msgs::msg::BatteryStatus;
  static constexpr TopicInfo info{"fmu/out/battery_status", Scope::kPx4, "sensor",
                                  kAutopilot | kSimulator};
};
struct Px4HomePosition {
  using Type = px4_msgs::msg::HomePosition;
  static constexpr TopicInfo info{"fmu/out/home_position", Scope::kPx4, "sensor",
                                  kAutopilot | kSimulator};
};
struct Px4FailsafeFlags {
  using Type = px4_msgs::msg::FailsafeFlags;
  static constexpr TopicInfo info{"fmu/out/failsafe_flags", Scope::kPx4, "sensor",
                                  kAutopilot | kSimulator};
};
struct Px4VehicleCommandAck {
  using Type = px4_msgs::msg::VehicleCommandAck;
  static constexpr TopicInfo info{"fmu/out/vehicle_command_ack", Scope::kPx4, "sensor",
                                  kAutopilot | kSimulator};
};
struct Px4ManualControlSetpoint {
  using Type = px4_msgs::msg::ManualControlSetpoint;
  static constexpr TopicInfo info{"fmu/out/manual_control_setpoint", Scope::kPx4, "sensor",
                                  kAutopilot | kSimulator};
};
struct Px4TimesyncStatus {
  using Type = px4_msgs::msg::TimesyncStatus;
  static constexpr TopicInfo info{"fmu/out/timesync_status", Scope::kPx4, "sensor",
                                  kAutopilot | kSimulator};
};
struct Px4OffboardControlMode {
  using Type = px4_msgs::msg::OffboardControlMode;
  static constexpr TopicInfo info{"fmu/in/offboard_control_mode", Scope::kPx4, "state", kGate};
};
struct Px4TrajectorySetpoint {
  using Type = px4_msgs::msg::TrajectorySetpoint;
  static constexpr TopicInfo info{"fmu/in/trajectory_setpoint", Scope::kPx4, "state", kGate};
};
struct Px4VehicleCommand {
  using Type = px4_msgs::msg::VehicleCommand;
  static constexpr TopicInfo info{"fmu/in/vehicle_command", Scope::kPx4, "command", kGate};
};

// what ROS 2's tools look for beside the topics
struct Rosout {
  using Type = rcl_interfaces::msg::Log;
  static constexpr TopicInfo info{"rosout", Scope::kShared, "log", kVehicle | kGate | kSimulator};
};
struct ParameterEvents {
  using Type = rcl_interfaces::msg::ParameterEvent;
  static constexpr TopicInfo info{"parameter_events", Scope::kShared, "command",
                                  kVehicle | kGate | kSimulator};
};
// the mode that the vehicle registers with PX4, for a pilot to select
struct Px4RegisterRequest {
  using Type = px4_msgs::msg::RegisterExtComponentRequest;
  static constexpr TopicInfo info{"fmu/in/register_ext_component_request", Scope::kPx4, "command",
                                  kGate};
};
struct Px4RegisterReply {
  using Type = px4_msgs::msg::RegisterExtComponentReply;
  static constexpr TopicInfo info{"fmu/out/register_ext_component_reply", Scope::kPx4, "sensor",
                                  kAutopilot | kSimulator};
};
struct Px4Unregister {
  using Type = px4_msgs::msg::UnregisterExtComponent;
  static constexpr TopicInfo info{"fmu/in/unregister_ext_component", Scope::kPx4, "command", kGate};
};
struct Px4ArmingCheckRequest {
  using Type = px4_msgs::msg::ArmingCheckRequest;
  static constexpr TopicInfo info{"fmu/out/arming_check_request", Scope::kPx4, "sensor",
                                  kAutopilot | kSimulator};
};
struct Px4ArmingCheckReply {
  using Type = px4_msgs::msg::ArmingCheckReply;
  static constexpr TopicInfo info{"fmu/in/arming_check_reply", Scope::kPx4, "state", kGate};
};
struct Px4ModeCompleted {
  using Type = px4_msgs::msg::ModeCompleted;
  static constexpr TopicInfo info{"fmu/in/mode_completed", Scope::kPx4, "command", kGate};
};

/// All of them, for the tests and the monitor.
using All =
    std::tuple<TargetObservation, DepthImage, DepthCameraInfo, ColorImage, ColorImageCompressed,
               ColorCameraInfo, Odometry, Clock, TargetState, LocalMap, OctoMap, MapPoints,
               TargetIntention, TargetPrediction, PlannedTrajectory, TargetSearch, SafetyState,
               MissionCommand, ServiceHealth, BodySightings, MovingBodies, TargetChoice,
               GroundImage, GroundVideo, GroundCameraInfo, FleetMember, FleetDivision, FleetBodies,
               FleetTarget, PredictionPath, PlanPath, Markers, Transforms, StaticTransforms,
               Diagnostics, Rosout, ParameterEvents, TargetTruth, VehicleTruth, Px4VehicleOdometry,
               Px4VehicleStatus, Px4VehicleLocalPosition, Px4VehicleControlMode, Px4BatteryStatus,
               Px4HomePosition, Px4FailsafeFlags, Px4VehicleCommandAck, Px4ManualControlSetpoint,
               Px4TimesyncStatus, Px4OffboardControlMode, Px4TrajectorySetpoint, Px4VehicleCommand,
               Px4RegisterRequest, Px4RegisterReply, Px4Unregister, Px4ArmingCheckRequest,
               Px4ArmingCheckReply, Px4ModeCompleted>;

}  // namespace foretrack::topics
