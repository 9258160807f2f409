// SPDX-License-Identifier: Apache-2.0
// The vehicle's state, its recent history, and what is commanded to its flight controller.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/common/geometry.hpp"

namespace foretrack {

/// Where the vehicle is and how it moves. World ENU, body FLU.
struct VehicleState {
  double stamp_s = 0.0;
  Vec3 position_enu_m = Vec3::Zero();
  Vec3 velocity_enu_m_s = Vec3::Zero();
  Quat q_world_body = Quat::Identity();  ///< attitude
  Vec3 angular_velocity_body_rad_s = Vec3::Zero();

  /// ENU, counter-clockwise from east.
  double yaw_rad() const { return yaw_of(q_world_body); }
  /// Position and attitude: a point in the body times this is the point in the world.
  Pose T_world_body() const {
    Pose pose = Pose::Identity();
    pose.linear() = q_world_body.toRotationMatrix();
    pose.translation() = position_enu_m;
    return pose;
  }
};

/// The last states of the vehicle, so that an image is put together with the pose at its own stamp.
/// It keeps a fixed number of states and drops the oldest.
class VehicleHistory {
 public:
  /// `capacity`: states that are kept, at least one. Their memory is taken here.
  explicit VehicleHistory(std::size_t capacity = 256)
      : capacity_(std::max<std::size_t>(capacity, 1)) {
    states_.reserve(capacity_);
  }
  /// Ignores a state that is not newer than the newest one. Allocates nothing (a copy of a history
  /// does, until it is full).
  void add(const VehicleState& state);
  /// The state at a stamp, between the two states around it: position and velocities linearly, the
  /// attitude by spherical interpolation. Up to slack_s before the oldest or after the newest state
  /// it is that state. None farther away. Cost: logarithmic in the states.
  std::optional<VehicleState> at(double stamp_s, double slack_s = 0.05) const;
  /// Null before the first one.
  const VehicleState* newest() const;

 private:
  std::size_t capacity_;
  std::vector<VehicleState> states_;  // a ring once full
  std::size_t next_ = 0;              // the oldest, once full
};

/// What the safety gate commands the flight controller to fly. NaN in a field: not controlled.
struct Setpoint {
  double stamp_s = 0.0;
  Vec3 position_enu_m = Vec3::Zero();
  Vec3 velocity_enu_m_s = Vec3::Zero();
  Vec3 acceleration_enu_m_s2 = Vec3::Zero();
  Vec3 jerk_enu_m_s3 = Vec3::Zero();
  double yaw_rad = 0.0;  ///< ENU
  double yaw_rate_rad_s = 0.0;
};

/// Who or what flies, as far as it matters to us.
enum class FlightMode : std::uint8_t {
  kUnknown,  // the flight controller does not say
  kOffboard,
  kPilot,  // by hand, with whatever help
  kHold,   // loiters
  kTakeOff,
  kReturn,
  kLand,
  kTermination,
  kOther,
};

/// What the flight controller says of itself.
struct AutopilotStatus {
  double stamp_s = -1.0;  ///< below 0: never heard of
  bool armed = false;     ///< the motors may turn
  bool offboard = false;  ///< it flies our setpoints, in offboard mode or in our own
  bool failsafe = false;  ///< it has taken over by itself
  FlightMode mode = FlightMode::kUnknown;
  bool sticks_moved = false;    ///< the pilot's, just now
  bool user_took_over = false;  ///< from a failsafe
  int system_id = 1;            ///< commands to another one are ignored without a word
  bool own_mode = false;        ///< it flies the mode that we registered with it
  bool own_selected = false;    ///< somebody has chosen that mode, whether it flies or not
};

/// What kind of thing is asked of a flight controller.
enum class CommandKind : std::uint8_t { kArm, kDisarm, kMode };

/// What may be asked of a flight controller.
struct AutopilotCommand {
  CommandKind kind = CommandKind::kMode;
  FlightMode mode = FlightMode::kHold;  ///< of kMode: to take off, to return and to land are modes
  bool forced = false;                  ///< of kDisarm: in the air, too
  int target_system = 1;                ///< 0: whoever hears it
};

/// Its answer, by the numbers of MAVLink's MAV_RESULT.
enum class CommandResult : std::uint8_t {
  kAccepted = 0,
  kTemporarilyRejected = 1,
  kDenied = 2,
  kUnsupported = 3,
  kFailed = 4,
  kInProgress = 5,
  kCancelled = 6,
};

}  // namespace foretrack
