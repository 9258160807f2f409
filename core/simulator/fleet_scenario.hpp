// SPDX-License-Identifier: Apache-2.0
// Several vehicles in one world: who they are, how they hear each other, and what befalls them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/common/geometry.hpp"

namespace foretrack {

/// One vehicle of a fleet.
struct FleetVehicle {
  std::string name;
  std::optional<Vec3> position_enu_m;  ///< none: beside the one before, where there is room
  double yaw_rad = 0.0;                ///< used with a position
  /// Where its odometry began: its own world is turned by frame_yaw_rad and lies at frame_m.
  Vec3 frame_m = Vec3::Zero();
  double frame_yaw_rad = 0.0;
};

/// From from_s to to_s, messages pass within a group only.
struct LinkPartition {
  double from_s = 0.0, to_s = 0.0;
  std::vector<std::vector<std::string>> groups;  ///< who is in none hears nobody
};

/// The radio between vehicles.
struct LinkParams {
  double loss = 0.0;  ///< share of messages that do not arrive, for each receiver
  double delay_s = 0.0;
  double jitter_s = 0.0;  ///< up to so much is added; messages may overtake each other
  std::vector<LinkPartition> partitions;
};

/// What may befall a vehicle.
enum class FleetFailureKind : std::uint8_t {
  kDies,   ///< is gone at once
  kLands,  ///< on an order
  kBlind,  ///< its camera sees nobody any more
  kJoins,  ///< is not there before
};
inline constexpr std::array<std::string_view, 4> kFleetFailureNames = {"dies", "lands", "blind",
                                                                       "joins"};
struct FleetFailure {
  std::string vehicle;
  double at_s = 0.0;
  FleetFailureKind kind = FleetFailureKind::kDies;
};

/// As PX4's own simulation calls its n-th vehicle (from 0): px4_1, px4_2, …
inline std::string px4_namespace_of(std::size_t vehicle) {
  return "px4_" + std::to_string(vehicle + 1);
}
/// And numbers it: PX4's instance n is system n + 1.
constexpr int px4_system_of(std::size_t vehicle) {
  return static_cast<int>(vehicle) + 2;
}

}  // namespace foretrack
