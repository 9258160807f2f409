// SPDX-License-Identifier: Apache-2.0
// One instant of a flight: truth, estimate, decision. The log has one line for each, the metrics
// are worked out from them and from nothing else.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/common/prediction.hpp"
#include "core/common/target.hpp"
#include "core/common/trajectory.hpp"
#include "core/common/vehicle.hpp"
#include "core/simulator/landmark_camera.hpp"

namespace foretrack {

/// Where the most probable path has the target, some seconds ahead; NaN: no prediction.
inline constexpr std::array<double, 4> kForesight_s = {0.5, 1.0, 2.0, 3.0};

inline std::array<Vec2, kForesight_s.size()> no_foresight() {
  std::array<Vec2, kForesight_s.size()> points;
  points.fill(Vec2::Constant(std::numeric_limits<double>::quiet_NaN()));
  return points;
}

struct FlightRow {
  double now_s = 0.0;
  // Truth.
  VehicleState vehicle;
  Vec3 acceleration_enu_m_s2 = Vec3::Zero();
  PersonState target;
  Sight sight;
  double clearance_m = 0.0;  // of the vehicle's centre to the nearest shape; infinite in the open
  AutopilotStatus autopilot;
  // What the tracker believes.
  TargetState estimate;
  std::array<IntentionBelief, kMaxIntentions> beliefs{};
  std::array<Vec2, kForesight_s.size()> foresight_m = no_foresight();
  // What it does.
  bool planned = false;  // a plan was made in this step
  PlanStatus plan_status = PlanStatus::kNone;
  PlanReason plan_reason = PlanReason::kOk;
  std::uint64_t plan_id = 0;
  std::string_view mode = "none";  // of the safety gate
  std::optional<Setpoint> setpoint;

  double distance_m() const { return distance_xy(vehicle.position_enu_m, target.position_enu_m); }
};

/// The log: a header and one line per row, fixed formatting, '.' as the decimal point in any
/// locale.
std::string csv_of(const std::vector<FlightRow>& rows);

/// Lower-case hexadecimal.
std::string sha256_of(std::string_view bytes);

}  // namespace foretrack
