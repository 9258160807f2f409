#include "services/common/validate.hpp"

#include <cmath>

#include "foretrack_msgs/msg/LocalMap.h"
#include "foretrack_msgs/msg/MissionCommand.h"
#include "foretrack_msgs/msg/PlannedTrajectory.h"
#include "foretrack_msgs/msg/SafetyState.h"
#include "foretrack_msgs/msg/ServiceHealth.h"
#include "foretrack_msgs/msg/TargetIntention.h"
#include "foretrack_msgs/msg/TargetObservation.h"
#include "foretrack_msgs/msg/TargetPrediction.h"
#include "foretrack_msgs/msg/TargetState.h"
#include "nav_msgs/msg/Odometry.h"
#include "px4_msgs/msg/TrajectorySetpoint.h"
#include "px4_msgs/msg/VehicleOdometry.h"
#include "rosgraph_msgs/msg/Clock.h"
#include "sensor_msgs/msg/CameraInfo.h"
#include "sensor_msgs/msg/Image.h"
#include "services/common/clock.hpp"

namespace foretrack {
namespace {

using namespace foretrack_msgs::msg;

constexpr const char* kNotFinite = "a number is not finite";
constexpr const char* kTooMany = "a sequence is longer than its bound";
constexpr const char* kBadCode = "a code is not one of its values";
constexpr const char* kBadRange = "a number is out of range";
constexpr const char* kBadQuaternion = "a quaternion is not of unit length";
constexpr const char* kBadSize = "sizes do not fit each other";
constexpr const char* kBadStamp = "the stamp is malformed";
constexpr const char* kFutureStamp = "the stamp is in the future";

constexpr double kFarthest_m = 1e5;
constexpr double kFastest_mps = 200.0;
constexpr double kFutureSlack_s = 0.5;
constexpr std::uint32_t kMaxImageSide_px = 8192;

template <class... Numbers>
bool finite(Numbers... numbers) {
  return (std::isfinite(numbers) && ...);
}

template <class Array>
bool all_finite(const Array& array) {
  for (const auto value : array)
    if (!std::isfinite(value)) return false;
  return true;
}

template <class Array>
bool within(const Array& array, double limit) {
  for (const auto value : array)
    if (!(std::abs(value) <= limit)) return false;
  return true;
}

bool is_probability(double p) {
  return p >= 0.0 && p <= 1.0 + 1e-6;
}

// NaN is a legal "not controlled" or "not known" in PX4's messages; infinity never is.
template <class Array>
bool none_infinite(const Array& array) {
  for (const auto value : array)
    if (std::isinf(value)) return false;
  return true;
}

template <class Angles>
const char* validate_plan(const Angles& plan) {
  if (plan.nodes().size() > 512) return kTooMany;
  if (!(plan.dt_s() >= 0.0 && plan.dt_s() <= 10.0)) return kBadRange;
  for (const auto& node : plan.nodes())
    if (!finite(node.angle_rad(), node.rate_radps())) return kNotFinite;
  return nullptr;
}

const char* validate_region(const ReachableRegion& r) {
  if (!within(r.center_m(), kFarthest_m) || !(r.radius_m() >= 0.0 && r.radius_m() <= 1e3))
    return kBadRange;
  const bool ok = finite(r.heading_rad(), r.left_bisector_yaw_rad(), r.left_half_angle_rad(),
                         r.right_bisector_yaw_rad(), r.right_half_angle_rad());
  return ok ? nullptr : kNotFinite;
}

}  // namespace

const char* validate_stamp(const builtin_interfaces::msg::Time& stamp, double now_s) {
  if (stamp.sec() < 0 || stamp.nanosec() >= 1000000000u) return kBadStamp;
  if (now_s > 0.0 && to_seconds(stamp) > now_s + kFutureSlack_s) return kFutureStamp;
  return nullptr;
}

const char* validate(const TargetObservation& m) {
  if (m.kind() == TargetObservation_Constants::KIND_NONE) return nullptr;
  if (m.kind() > TargetObservation_Constants::KIND_POSITION) return kBadCode;
  if (m.kind() == TargetObservation_Constants::KIND_POSITION) {
    if (!within(m.position_m(), kFarthest_m)) return kBadRange;
    if (!all_finite(m.position_covariance_m2())) return kNotFinite;
  }
  if (m.kind() != TargetObservation_Constants::KIND_LANDMARKS) return nullptr;
  if (m.landmarks().size() != 33) return kBadSize;
  const auto& c = m.camera();
  const bool focal = c.fx_px() > 0.0 && c.fy_px() > 0.0 && finite(c.fx_px(), c.fy_px());
  if (!focal || !finite(c.cx_px(), c.cy_px())) return kBadRange;
  for (const auto& l : m.landmarks()) {
    if (!finite(l.image_x_px(), l.image_y_px(), l.body_x_m(), l.body_y_m(), l.body_z_m()))
      return kNotFinite;
    if (!is_probability(l.visibility())) return kBadRange;
  }
  return nullptr;
}

const char* validate(const TargetState& m) {
  if (m.status() > TargetState_Constants::STATUS_LOST) return kBadCode;
  if (m.status() == TargetState_Constants::STATUS_NONE) return nullptr;
  if (!within(m.position_m(), kFarthest_m) || !within(m.velocity_mps(), kFastest_mps))
    return kBadRange;
  if (!all_finite(m.covariance())) return kNotFinite;
  for (int i = 0; i < 6; ++i)
    if (m.covariance()[7 * i] < 0.0) return kBadRange;
  return nullptr;
}

const char* validate(const TargetIntention& m) {
  if (m.intentions().size() > 16) return kTooMany;
  for (const auto& row : m.intentions()) {
    if (!finite(row.potential(), row.observation(), row.score())) return kNotFinite;
    if (!is_probability(row.probability())) return kBadRange;
  }
  if (const char* why = validate_region(m.region_now())) return why;
  return validate_region(m.region_ahead());
}

const char* validate(const TargetPrediction& m) {
  if (m.status() > TargetPrediction_Constants::STATUS_SEARCH_EXHAUSTED) return kBadCode;
  if (m.paths().size() > 16) return kTooMany;
  for (const auto& path : m.paths()) {
    if (path.states().size() > 64) return kTooMany;
    if (!is_probability(path.probability())) return kBadRange;
    for (const auto& s : path.states()) {
      if (!(s.time_from_stamp_s() >= 0.0 && s.time_from_stamp_s() <= 60.0)) return kBadRange;
      if (!within(s.position_m(), kFarthest_m) || !within(s.velocity_mps(), kFastest_mps))
        return kBadRange;
      if (!all_finite(s.covariance_xy_m2())) return kNotFinite;
    }
  }
  return nullptr;
}

const char* validate(const LocalMap& m) {
  if (!(m.resolution_m() >= 0.01 && m.resolution_m() <= 10.0)) return kBadRange;
  if (!within(m.origin_m(), kFarthest_m)) return kBadRange;
  std::uint64_t cells = 1;
  for (const std::uint64_t size : {m.size_x(), m.size_y(), m.size_z()}) {
    if (size > LocalMap_Constants::MAX_CELLS) return kTooMany;
    cells *= size;
    if (cells > LocalMap_Constants::MAX_CELLS) return kTooMany;
  }
  if (m.cells().size() != cells || m.occupied_distance_cm().size() != cells ||
      m.unfree_distance_cm().size() != cells)
    return kBadSize;
  for (const auto cell : m.cells())
    if (cell > LocalMap_Constants::CELL_UNKNOWN) return kBadCode;
  return nullptr;
}

const char* validate(const PlannedTrajectory& m) {
  if (m.status() > PlannedTrajectory_Constants::STATUS_HOLD ||
      m.reason() > PlannedTrajectory_Constants::REASON_TOO_NEAR_TARGET)
    return kBadCode;
  if (m.pieces().size() > 64 || m.visible_regions().size() > 64 || m.corridor().size() > 32 ||
      m.stage_times().size() > 16)
    return kTooMany;
  if (const char* why = validate_stamp(m.start(), 0.0)) return why;
  for (const auto& piece : m.pieces()) {
    if (!(piece.duration_s() > 0.0 && piece.duration_s() <= 60.0)) return kBadRange;
    for (const auto& row : piece.coefficients())
      if (!all_finite(row)) return kNotFinite;
    if (!within(piece.coefficients()[0], kFarthest_m)) return kBadRange;
  }
  if (!finite(m.tail_start_s())) return kNotFinite;
  if (const char* why = validate_plan(m.yaw())) return why;
  if (const char* why = validate_plan(m.gimbal_pitch())) return why;
  for (const auto& r : m.visible_regions()) {
    if (!finite(r.time_from_start_s(), r.bisector_yaw_rad(), r.half_angle_rad())) return kNotFinite;
    if (!within(r.target_position_m(), kFarthest_m) || !within(r.waypoint_m(), kFarthest_m))
      return kBadRange;
  }
  for (const auto& polytope : m.corridor()) {
    if (polytope.faces().size() > 64) return kTooMany;
    for (const auto& face : polytope.faces())
      if (!all_finite(face.normal()) || !finite(face.offset_m())) return kNotFinite;
  }
  return nullptr;
}

const char* validate(const SafetyState& m) {
  if (m.mode() > SafetyState_Constants::MODE_SILENT ||
      m.reason() > SafetyState_Constants::REASON_MISSION ||
      m.request() > SafetyState_Constants::REQUEST_LAND ||
      m.phase() > SafetyState_Constants::PHASE_STOPPED ||
      m.command_result() > SafetyState_Constants::RESULT_REFUSED_PHASE)
    return kBadCode;
  return finite(m.plan_age_s(), m.odometry_age_s(), m.deviation_m()) ? nullptr : kNotFinite;
}

const char* validate(const MissionCommand& m) {
  return m.command() > MissionCommand_Constants::COMMAND_STOP ? kBadCode : nullptr;
}

const char* validate(const ServiceHealth& m) {
  if (m.state() > ServiceHealth_Constants::STATE_STOPPING) return kBadCode;
  if (m.topics().size() > 64) return kTooMany;
  for (const auto& topic : m.topics())
    if (topic.rejected().size() > 16) return kTooMany;
  return finite(m.cpu_percent(), m.loop_mean_ms(), m.loop_max_ms()) ? nullptr : kNotFinite;
}

const char* validate(const nav_msgs::msg::Odometry& m) {
  const auto& p = m.pose().pose().position();
  const auto& q = m.pose().pose().orientation();
  const auto& v = m.twist().twist().linear();
  const auto& w = m.twist().twist().angular();
  if (!within(std::array{p.x(), p.y(), p.z()}, kFarthest_m)) return kBadRange;
  if (!within(std::array{v.x(), v.y(), v.z()}, kFastest_mps)) return kBadRange;
  if (!finite(w.x(), w.y(), w.z())) return kNotFinite;
  const double norm = std::sqrt(q.x() * q.x() + q.y() * q.y() + q.z() * q.z() + q.w() * q.w());
  return std::abs(norm - 1.0) < 1e-2 ? nullptr : kBadQuaternion;
}

const char* validate(const sensor_msgs::msg::Image& m) {
  if (m.width() == 0 || m.height() == 0 || m.width() > kMaxImageSide_px ||
      m.height() > kMaxImageSide_px)
    return kBadRange;
  if (m.step() < m.width() || m.data().size() != std::size_t{m.step()} * m.height())
    return kBadSize;
  return nullptr;
}

const char* validate(const sensor_msgs::msg::CameraInfo& m) {
  if (m.width() == 0 || m.height() == 0 || m.width() > kMaxImageSide_px ||
      m.height() > kMaxImageSide_px)
    return kBadRange;
  if (m.d().size() > 14) return kTooMany;
  if (!all_finite(m.k()) || !all_finite(m.d())) return kNotFinite;
  return m.k()[0] > 0.0 && m.k()[4] > 0.0 ? nullptr : kBadRange;
}

const char* validate(const rosgraph_msgs::msg::Clock& m) {
  return validate_stamp(m.clock(), 0.0);
}

const char* validate(const px4_msgs::msg::VehicleOdometry& m) {
  const bool ok = none_infinite(m.position()) && none_infinite(m.q()) &&
                  none_infinite(m.velocity()) && none_infinite(m.angular_velocity());
  return ok ? nullptr : kNotFinite;
}

const char* validate(const px4_msgs::msg::TrajectorySetpoint& m) {
  const bool ok = none_infinite(m.position()) && none_infinite(m.velocity()) &&
                  none_infinite(m.acceleration()) && !std::isinf(m.yaw()) &&
                  !std::isinf(m.yawspeed());
  return ok ? nullptr : kNotFinite;
}

}  // namespace foretrack
