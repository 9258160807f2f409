// SPDX-License-Identifier: Apache-2.0
#include "services/convert/trajectory.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "services/convert/geometry.hpp"
#include "services/convert/pieces.hpp"

namespace foretrack {
namespace {

namespace msg = foretrack_msgs::msg;
namespace c = msg::PlannedTrajectory_Constants;
static_assert(c::STATUS_NONE == int(PlanStatus::kNone));
static_assert(c::STATUS_FRESH == int(PlanStatus::kFresh));
static_assert(c::STATUS_KEPT == int(PlanStatus::kKept));
static_assert(c::STATUS_SEARCH == int(PlanStatus::kSearch));
static_assert(c::STATUS_HOLD == int(PlanStatus::kHold));
static_assert(c::REASON_OK == int(PlanReason::kOk));
static_assert(c::REASON_NO_TARGET == int(PlanReason::kNoTarget));
static_assert(c::REASON_TARGET_LOST == int(PlanReason::kTargetLost));
static_assert(c::REASON_STALE_INPUT == int(PlanReason::kStaleInput));
static_assert(c::REASON_EMPTY_CORRIDOR == int(PlanReason::kEmptyCorridor));
static_assert(c::REASON_NOT_CONVERGED == int(PlanReason::kNotConverged));
static_assert(c::REASON_LIMITS_VIOLATED == int(PlanReason::kLimitsViolated));
static_assert(c::REASON_CLEARANCE_VIOLATED == int(PlanReason::kClearanceViolated));
static_assert(c::REASON_DISCONTINUOUS == int(PlanReason::kDiscontinuous));
static_assert(c::REASON_TAIL_UNSAFE == int(PlanReason::kTailUnsafe));
static_assert(c::REASON_TOO_NEAR_TARGET == int(PlanReason::kTooNearTarget));

constexpr std::size_t kMaxPieces = 64;
constexpr std::size_t kMaxNodes = 512;
constexpr std::size_t kMaxRegions = 64;
constexpr std::size_t kMaxPolytopes = 32;
constexpr std::size_t kMaxFaces = 64;

void check_length(const char* field, std::size_t size, std::size_t max) {
  if (size > max) throw std::length_error(fmt::format("{}: {} long, at most {}", field, size, max));
}

void to_idl(const AnglePlan& in, msg::AnglePlan& out) {
  check_length("PlannedTrajectory.nodes", in.nodes.size(), kMaxNodes);
  out.dt_s(in.nodes.empty() ? 0.0 : in.dt_s);
  out.nodes().resize(in.nodes.size());
  for (std::size_t i = 0; i < in.nodes.size(); ++i) {
    out.nodes()[i].angle_rad(in.nodes[i].angle_rad);
    out.nodes()[i].rate_radps(in.nodes[i].rate_rad_s);
  }
}

AnglePlan read_angles(Checks& checks, const msg::AnglePlan& in) {
  AnglePlan out;
  checks.count("yaw.nodes", in.nodes().size(), 0, kMaxNodes);
  if (in.nodes().empty() || !checks.ok()) return out;
  checks.positive("yaw.dt_s", in.dt_s(), limits::kDuration_s);
  out.dt_s = in.dt_s();
  out.nodes.reserve(in.nodes().size());
  for (const auto& node : in.nodes()) {
    checks.within("yaw.nodes.angle_rad", node.angle_rad(), limits::kAngle_rad);
    checks.within("yaw.nodes.rate_radps", node.rate_radps(), limits::kRate_rad_s);
    out.nodes.push_back({node.angle_rad(), node.rate_radps()});
  }
  return out;
}

QuinticPiece read_piece(Checks& checks, const msg::TrajectoryPiece& in) {
  QuinticPiece out;
  checks.positive("pieces.duration_s", in.duration_s(), limits::kDuration_s);
  out.duration_s = in.duration_s();
  for (int row = 0; row < 6; ++row)
    for (int axis = 0; axis < 3; ++axis) {
      checks.within("pieces.coefficients", in.coefficients()[row][axis], 1e9);
      out.coefficients(row, axis) = in.coefficients()[row][axis];
    }
  check_ends(checks, out);
  return out;
}

void read_pieces(Checks& checks, const msg::PlannedTrajectory& in, PlannedTrajectory& out) {
  const bool flies = out.status == PlanStatus::kFresh || out.status == PlanStatus::kKept ||
                     out.status == PlanStatus::kSearch;
  checks.count("pieces", in.pieces().size(), flies ? 1 : 0, kMaxPieces);
  if (!checks.ok()) return;
  out.pieces.reserve(in.pieces().size());
  for (const auto& piece : in.pieces()) {
    out.pieces.push_back(read_piece(checks, piece));
    const std::size_t n = out.pieces.size();
    if (n > 1) check_join(checks, out.pieces[n - 2], out.pieces[n - 1]);
  }
  checks.in_range("tail_start_s", in.tail_start_s(), 0.0, out.duration_s() + 1e-6);
  out.tail_start_s = in.tail_start_s();
}

VisibleRegion read_region(Checks& checks, const msg::VisibleRegion& in) {
  checks.in_range("visible_regions.time_from_start_s", in.time_from_start_s(), -limits::kDuration_s,
                  limits::kDuration_s);
  checks.within("visible_regions.target_position_m", in.target_position_m(), limits::kPosition_m);
  checks.within("visible_regions.bisector_yaw_rad", in.bisector_yaw_rad(), limits::kAngle_rad);
  checks.in_range("visible_regions.half_angle_rad", in.half_angle_rad(), 0.0, kPi);
  checks.within("visible_regions.waypoint_m", in.waypoint_m(), limits::kPosition_m);
  return {in.time_from_start_s(), to_vec3(in.target_position_m()), in.bisector_yaw_rad(),
          in.half_angle_rad(), to_vec3(in.waypoint_m())};
}

Polytope read_polytope(Checks& checks, const msg::CorridorPolytope& in) {
  Polytope out;
  checks.count("corridor.faces", in.faces().size(), 0, kMaxFaces);
  if (!checks.ok()) return out;
  out.planes.reserve(in.faces().size());
  for (const auto& face : in.faces()) {
    const Vec3 normal = to_vec3(face.normal());
    checks.unit("corridor.faces.normal", normal.norm());
    checks.within("corridor.faces.offset_m", face.offset_m(), 2.0 * limits::kPosition_m);
    out.planes.emplace_back(normal.x(), normal.y(), normal.z(), face.offset_m());
  }
  return out;
}

void set_pieces(const std::vector<QuinticPiece>& in, std::vector<msg::TrajectoryPiece>& out) {
  check_length("PlannedTrajectory.pieces", in.size(), kMaxPieces);
  out.resize(in.size());
  for (std::size_t i = 0; i < in.size(); ++i) {
    out[i].duration_s(in[i].duration_s);
    for (int row = 0; row < 6; ++row)
      for (int axis = 0; axis < 3; ++axis)
        out[i].coefficients()[row][axis] = in[i].coefficients(row, axis);
  }
}

void set_regions(const std::vector<VisibleRegion>& in, std::vector<msg::VisibleRegion>& out) {
  check_length("PlannedTrajectory.visible_regions", in.size(), kMaxRegions);
  out.resize(in.size());
  for (std::size_t i = 0; i < in.size(); ++i) {
    out[i].time_from_start_s(in[i].time_s);
    out[i].target_position_m(to_array(in[i].target_enu_m));
    out[i].bisector_yaw_rad(in[i].bisector_rad);
    out[i].half_angle_rad(in[i].half_angle_rad);
    out[i].waypoint_m(to_array(in[i].waypoint_enu_m));
  }
}

void set_corridor(const std::vector<Polytope>& in, std::vector<msg::CorridorPolytope>& out) {
  check_length("PlannedTrajectory.corridor", in.size(), kMaxPolytopes);
  out.resize(in.size());
  for (std::size_t i = 0; i < in.size(); ++i) {
    check_length("PlannedTrajectory.corridor.faces", in[i].planes.size(), kMaxFaces);
    out[i].faces().resize(in[i].planes.size());
    for (std::size_t k = 0; k < in[i].planes.size(); ++k) {
      out[i].faces()[k].normal(to_array(in[i].planes[k].head<3>()));
      out[i].faces()[k].offset_m(in[i].planes[k][3]);
    }
  }
}

}  // namespace

void to_idl(const PlannedTrajectory& in, msg::PlannedTrajectory& out) {
  set_header(out.header(), in.stamp_s);
  out.id(in.id);
  out.start(to_time(in.start_s));
  out.status(static_cast<std::uint8_t>(in.status));
  out.reason(static_cast<std::uint8_t>(in.reason));
  out.text(fmt::format("{}: {}", to_string(in.status), to_string(in.reason)));
  set_pieces(in.pieces, out.pieces());
  out.tail_start_s(in.tail_start_s);
  to_idl(in.yaw, out.yaw());
  to_idl(in.gimbal_pitch, out.gimbal_pitch());
  set_regions(in.visible_regions, out.visible_regions());
  set_corridor(in.corridor, out.corridor());
}

Converted<PlannedTrajectory> from_idl(const msg::PlannedTrajectory& in) {
  Checks checks;
  PlannedTrajectory out;
  check_header(checks, in.header());
  checks.stamp("start", in.start());
  checks.enumerator("status", in.status(), c::STATUS_HOLD);
  checks.enumerator("reason", in.reason(), c::REASON_TOO_NEAR_TARGET);
  checks.count("visible_regions", in.visible_regions().size(), 0, kMaxRegions);
  checks.count("corridor", in.corridor().size(), 0, kMaxPolytopes);
  if (!checks.ok()) return checks.result(std::move(out));
  out.id = in.id();
  out.stamp_s = seconds(in.header().stamp());
  out.start_s = seconds(in.start());
  out.status = static_cast<PlanStatus>(in.status());
  out.reason = static_cast<PlanReason>(in.reason());
  read_pieces(checks, in, out);
  out.yaw = read_angles(checks, in.yaw());
  out.gimbal_pitch = read_angles(checks, in.gimbal_pitch());
  for (const auto& region : in.visible_regions())
    out.visible_regions.push_back(read_region(checks, region));
  for (const auto& polytope : in.corridor())
    out.corridor.push_back(read_polytope(checks, polytope));
  return checks.result(std::move(out));
}

}  // namespace foretrack
