// SPDX-License-Identifier: Apache-2.0
#include "services/convert/safety.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "services/convert/geometry.hpp"

namespace foretrack {
namespace {

namespace msg = foretrack_msgs::msg;
namespace o = msg::MissionCommand_Constants;
namespace s = msg::SafetyState_Constants;
static_assert(o::COMMAND_START == int(MissionOrder::kStart));
static_assert(o::COMMAND_HOLD == int(MissionOrder::kHold));
static_assert(o::COMMAND_RESUME == int(MissionOrder::kResume));
static_assert(o::COMMAND_RETURN == int(MissionOrder::kReturn));
static_assert(o::COMMAND_LAND == int(MissionOrder::kLand));
static_assert(o::COMMAND_STOP == int(MissionOrder::kStop));
static_assert(o::COMMAND_LEASE == int(MissionOrder::kLease));
static_assert(o::COMMAND_RELEASE == int(MissionOrder::kRelease));
static_assert(o::COMMAND_TAKE_OFF == int(MissionOrder::kTakeOff));
static_assert(o::COMMAND_SET_BOUNDS == int(MissionOrder::kSetBounds));
static_assert(o::COMMAND_FOLLOW == int(MissionOrder::kFollow));
static_assert(o::COMMAND_SET_FRAMING == int(MissionOrder::kSetFraming));
static_assert(o::COMMAND_SET_RETURN_PLACE == int(MissionOrder::kSetReturnPlace));
static_assert(s::MODE_TRACK == int(SafetyMode::kTrack));
static_assert(s::MODE_COAST == int(SafetyMode::kCoast));
static_assert(s::MODE_HOVER == int(SafetyMode::kHover));
static_assert(s::MODE_BRAKE == int(SafetyMode::kBrake));
static_assert(s::MODE_SILENT == int(SafetyMode::kSilent));
static_assert(s::REASON_NONE == int(SafetyReason::kNone));
static_assert(s::REASON_NO_PLAN_YET == int(SafetyReason::kNoPlanYet));
static_assert(s::REASON_PLAN_STALE == int(SafetyReason::kPlanStale));
static_assert(s::REASON_PLAN_ENDED == int(SafetyReason::kPlanEnded));
static_assert(s::REASON_PLAN_HOLDS == int(SafetyReason::kPlanHolds));
static_assert(s::REASON_OFF_TRAJECTORY == int(SafetyReason::kOffTrajectory));
static_assert(s::REASON_VEHICLE_STALE == int(SafetyReason::kVehicleStale));
static_assert(s::REASON_AUTOPILOT_STALE == int(SafetyReason::kAutopilotStale));
static_assert(s::REASON_NOT_OFFBOARD == int(SafetyReason::kNotOffboard));
static_assert(s::REASON_MISSION == int(SafetyReason::kMission));
static_assert(s::REASON_ODOMETRY_JUMPS == int(SafetyReason::kOdometryJumps));
static_assert(s::REASON_ODOMETRY_FROZEN == int(SafetyReason::kOdometryFrozen));
static_assert(s::REASON_ODOMETRY_DISAGREES == int(SafetyReason::kOdometryDisagrees));
static_assert(s::REASON_PLAN_BLOCKED == int(SafetyReason::kPlanBlocked));
static_assert(s::REASON_BODY_NEAR == int(SafetyReason::kBodyNear));
static_assert(s::REASON_FENCE == int(SafetyReason::kFence));
static_assert(s::REASON_ALTITUDE == int(SafetyReason::kAltitude));
static_assert(s::REASON_BATTERY == int(SafetyReason::kBattery));
static_assert(s::REASON_LINK == int(SafetyReason::kLink));
static_assert(s::REASON_IMAGES == int(SafetyReason::kImages));
static_assert(s::PHASE_IDLE == int(MissionPhase::kIdle));
static_assert(s::PHASE_TRACKING == int(MissionPhase::kTracking));
static_assert(s::PHASE_HOLDING == int(MissionPhase::kHolding));
static_assert(s::PHASE_RETURNING == int(MissionPhase::kReturning));
static_assert(s::PHASE_LANDING == int(MissionPhase::kLanding));
static_assert(s::PHASE_STOPPED == int(MissionPhase::kStopped));
static_assert(s::PHASE_STARTING == int(MissionPhase::kStarting));
static_assert(s::PHASE_TAKING_OFF == int(MissionPhase::kTakingOff));
static_assert(s::REQUEST_NONE == int(AutopilotRequest::kNone));
static_assert(s::REQUEST_ARM == int(AutopilotRequest::kArm));
static_assert(s::REQUEST_OFFBOARD == int(AutopilotRequest::kOffboard));
static_assert(s::REQUEST_RETURN == int(AutopilotRequest::kReturn));
static_assert(s::REQUEST_LAND == int(AutopilotRequest::kLand));
static_assert(s::REQUEST_TAKE_OFF == int(AutopilotRequest::kTakeOff));
static_assert(s::REQUEST_HOLD == int(AutopilotRequest::kHold));
static_assert(s::REQUEST_HOME == int(AutopilotRequest::kHome));
static_assert(s::REQUEST_PILOT == int(AutopilotRequest::kPilot));
static_assert(s::RESULT_NONE == int(MissionResult::kNone));
static_assert(s::RESULT_ACCEPTED == int(MissionResult::kAccepted));
static_assert(s::RESULT_REFUSED_LATE == int(MissionResult::kRefusedLate));
static_assert(s::RESULT_REFUSED_REPEATED == int(MissionResult::kRefusedRepeated));
static_assert(s::RESULT_REFUSED_PHASE == int(MissionResult::kRefusedPhase));
static_assert(s::RESULT_REFUSED_FOREIGN == int(MissionResult::kRefusedForeign));
static_assert(s::RESULT_REFUSED_FUTURE == int(MissionResult::kRefusedFuture));
static_assert(s::RESULT_REFUSED_UNPROVED == int(MissionResult::kRefusedUnproved));
static_assert(s::RESULT_REFUSED_UNWRITTEN == int(MissionResult::kRefusedUnwritten));
static_assert(s::RESULT_REFUSED_BOUNDS == int(MissionResult::kRefusedBounds));
static_assert(s::RESULT_PENDING == int(MissionResult::kPending));
static_assert(s::RESULT_ACCEPTED_UNWRITTEN == int(MissionResult::kAcceptedUnwritten));
static_assert(s::RESULT_REFUSED_PERSON == int(MissionResult::kRefusedPerson));
static_assert(s::RESULT_REFUSED_FRAMING == int(MissionResult::kRefusedFraming));
static_assert(s::RESULT_REFUSED_PLACE == int(MissionResult::kRefusedPlace));
static_assert(s::ANSWER_CANCELLED == int(CommandResult::kCancelled));
static_assert(s::END_PILOT == int(MissionEnd::kPilot));
static_assert(s::END_STICKS == int(MissionEnd::kSticks));
static_assert(s::END_OTHER_MODE == int(MissionEnd::kOtherMode));
static_assert(s::END_DISARMED == int(MissionEnd::kDisarmed));
static_assert(s::END_FAILSAFE == int(MissionEnd::kFailsafe));
static_assert(s::END_TERMINATED == int(MissionEnd::kTerminated));
static_assert(s::END_REFUSED == int(MissionEnd::kRefused));
static_assert(s::END_NO_ANSWER == int(MissionEnd::kNoAnswer));
static_assert(s::END_NOT_DONE == int(MissionEnd::kNotDone));
static_assert(s::END_NOT_READY == int(MissionEnd::kNotReady));
static_assert(s::END_DONE == int(MissionEnd::kDone));
static_assert(s::END_UNWRITTEN == int(MissionEnd::kUnwritten));
static_assert(s::END_FENCE == int(MissionEnd::kFence));
static_assert(s::END_BATTERY == int(MissionEnd::kBattery));
static_assert(s::END_LINK == int(MissionEnd::kLink));

// As an order has them, and the state.
template <typename Message>
void write_bounds(const FlightBounds& in, Message& out) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  out.fence_m().clear();
  for (int i = 0; i < in.corner_count; ++i)
    for (const double value : {in.corners_enu_m[i].x_m, in.corners_enu_m[i].y_m})
      out.fence_m().push_back(value);
  out.altitude_min_m(std::isfinite(in.altitude_min_m) ? in.altitude_min_m : kNaN);
  out.altitude_max_m(std::isfinite(in.altitude_max_m) ? in.altitude_max_m : kNaN);
}

template <typename Message>
FlightBounds read_bounds(Checks& checks, const Message& in) {
  FlightBounds out;
  const auto& fence = in.fence_m();
  if (fence.size() % 2 != 0 || fence.size() > 2 * FlightBounds::kMaxCorners)
    checks.fail("fence_m", std::to_string(fence.size()) + " numbers", "x, y of 32 corners at most");
  for (const double value : fence) checks.within("fence_m", value, limits::kPosition_m);
  if (!checks.ok()) return out;
  out.corner_count = static_cast<int>(fence.size() / 2);
  for (std::size_t i = 0; i < fence.size() / 2; ++i)
    out.corners_enu_m[i] = {fence[2 * i], fence[2 * i + 1]};
  if (!std::isnan(in.altitude_min_m())) out.altitude_min_m = in.altitude_min_m();
  if (!std::isnan(in.altitude_max_m())) out.altitude_max_m = in.altitude_max_m();
  return out;
}

void write_framing(const Framing& in, msg::TargetFraming& out) {
  out.distance_m(in.distance_m);
  out.height_m(in.height_m);
  out.bearing_rad(in.bearing_rad);
  out.circling_radps(in.circling_rad_s);
}

// "brake: no fresh plan (idle: the pilot took over); arm: denied"
std::string text_of(const GateReport& in) {
  const GateResult& r = in.result;
  std::string text = fmt::format("{}{}: {} ({}", in.dry_run ? "dry run: " : "", to_string(r.mode),
                                 to_string(r.reason), to_string(r.phase));
  if (r.end != MissionEnd::kNone) text += fmt::format(": {}", to_string(r.end));
  text += ')';
  if (r.asked != AutopilotRequest::kNone && r.answer != CommandResult::kAccepted)
    text += fmt::format("; {}: {}", to_string(r.asked), to_string(r.answer));
  if (r.refusal != PlanFault::kNone)
    text += fmt::format("; the last plan: {}", to_string(r.refusal));
  if (!in.hindrance.empty()) text += "; the autopilot would refuse: " + in.hindrance;
  if (!in.alarm.empty()) text += "; " + in.alarm;
  return text;
}

void set_setpoint(const GateReport& in, msg::SafetyState& out) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const Vec3 none = Vec3::Constant(kNaN);
  const auto& sp = in.result.setpoint;
  out.setpoint_valid(sp.has_value());
  out.position_m(to_array(sp ? sp->position_enu_m : none));
  out.velocity_mps(to_array(sp ? sp->velocity_enu_m_s : none));
  out.acceleration_mps2(to_array(sp ? sp->acceleration_enu_m_s2 : none));
  out.yaw_rad(sp ? sp->yaw_rad : kNaN);
  out.yaw_rate_radps(sp ? sp->yaw_rate_rad_s : kNaN);
}

// NaN is a value here: not controlled.
void within_or_nan(Checks& checks, std::string_view field, double value, double limit) {
  if (!std::isnan(value)) checks.within(field, value, limit);
}
void within_or_nan(Checks& checks, std::string_view field, const std::array<double, 3>& values,
                   double limit) {
  for (const double v : values) within_or_nan(checks, field, v, limit);
}

// How far the vehicle may go is the gate's to judge.
Framing read_framing(Checks& checks, const msg::TargetFraming& in) {
  within_or_nan(checks, "framing.distance_m", in.distance_m(), limits::kPosition_m);
  within_or_nan(checks, "framing.height_m", in.height_m(), limits::kPosition_m);
  within_or_nan(checks, "framing.bearing_rad", in.bearing_rad(), limits::kAngle_rad);
  checks.within("framing.circling_radps", in.circling_radps(), limits::kRate_rad_s);
  Framing out;
  out.distance_m = in.distance_m();
  out.height_m = in.height_m();
  out.bearing_rad = in.bearing_rad();
  out.circling_rad_s = in.circling_radps();
  return out;
}

Setpoint read_setpoint(Checks& checks, const msg::SafetyState& in) {
  within_or_nan(checks, "position_m", in.position_m(), limits::kPosition_m);
  within_or_nan(checks, "velocity_mps", in.velocity_mps(), limits::kSpeed_m_s);
  within_or_nan(checks, "acceleration_mps2", in.acceleration_mps2(), limits::kAcceleration_m_s2);
  within_or_nan(checks, "yaw_rad", in.yaw_rad(), limits::kAngle_rad);
  within_or_nan(checks, "yaw_rate_radps", in.yaw_rate_radps(), limits::kRate_rad_s);
  Setpoint out;
  out.stamp_s = seconds(in.header().stamp());
  out.position_enu_m = to_vec3(in.position_m());
  out.velocity_enu_m_s = to_vec3(in.velocity_mps());
  out.acceleration_enu_m_s2 = to_vec3(in.acceleration_mps2());
  out.jerk_enu_m_s3 = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  out.yaw_rad = in.yaw_rad();
  out.yaw_rate_rad_s = in.yaw_rate_radps();
  return out;
}

}  // namespace

void to_idl(const MissionCommand& in, msg::MissionCommand& out) {
  set_header(out.header(), in.stamp_s);
  out.id(in.id);
  out.command(static_cast<std::uint8_t>(in.order));
  out.operator_id(std::string(in.operator_name.view()));
  out.lease_id(std::string(in.lease_id.view()));
  out.proof({});
  write_bounds(in.bounds, out);
  out.person_id(in.person_id);
  write_framing(in.framing, out.framing());
  out.return_place_m({in.return_place_enu_m.x_m, in.return_place_enu_m.y_m});
}

Converted<MissionCommand> from_idl(const msg::MissionCommand& in) {
  Checks checks;
  checks.stamp("header.stamp", in.header().stamp());
  checks.enumerator("command", in.command(), o::COMMAND_SET_RETURN_PLACE);
  if (in.id() == 0) checks.fail("id", "0", "1 or more");
  MissionCommand out;
  out.id = in.id();
  out.stamp_s = seconds(in.header().stamp());
  out.order = static_cast<MissionOrder>(in.command());
  out.operator_name = in.operator_id().c_str();
  out.lease_id = in.lease_id().c_str();
  if (out.order == MissionOrder::kSetBounds) out.bounds = read_bounds(checks, in);
  if (out.order == MissionOrder::kFollow) out.person_id = in.person_id();
  if (out.order == MissionOrder::kSetFraming) out.framing = read_framing(checks, in.framing());
  if (out.order == MissionOrder::kSetReturnPlace) {
    const auto& [x_m, y_m] =
        out.return_place_enu_m = {in.return_place_m()[0], in.return_place_m()[1]};
    checks.within("return_place_m", x_m, limits::kPosition_m);
    checks.within("return_place_m", y_m, limits::kPosition_m);
  }
  return checks.result(out);
}

constexpr std::size_t kTextBytes = 256, kAlarmBytes = 128;  // as the IDL bounds them

void to_idl(const GateReport& in, msg::SafetyState& out) {
  const GateResult& r = in.result;
  set_header(out.header(), in.stamp_s);
  out.caused_by(to_time(in.caused_by_s));
  out.mode(static_cast<std::uint8_t>(r.mode));
  out.reason(static_cast<std::uint8_t>(r.reason));
  out.phase(static_cast<std::uint8_t>(r.phase));
  out.request(static_cast<std::uint8_t>(r.request));
  out.text(text_of(in).substr(0, kTextBytes));
  out.trajectory_id(r.plan_id);
  out.plan_age_s(r.plan_age_s);
  out.deviation_m(r.deviation_m);
  out.odometry_age_s(in.odometry_age_s);
  out.offboard(in.autopilot.offboard);
  out.armed(in.autopilot.armed);
  out.heartbeat(r.heartbeat);
  set_setpoint(in, out);
  out.command_id(r.command_id);
  out.command(static_cast<std::uint8_t>(in.order));
  out.command_result(static_cast<std::uint8_t>(r.command_result));
  out.operator_id(in.operator_name);
  out.lease_operator(in.lease_operator);
  out.lease_remaining_s(in.lease_remaining_s);
  out.mission_end(static_cast<std::uint8_t>(r.end));
  out.asked(static_cast<std::uint8_t>(r.asked));
  out.answer(static_cast<std::uint8_t>(r.answer));
  out.dry_run(in.dry_run);
  out.alarm(in.alarm.substr(0, kAlarmBytes));
  out.chosen(r.person.made);
  out.person_id(r.person.person_id);
  write_framing(r.framing, out.framing());
  write_bounds(r.bounds, out);
  out.home_known(in.home_enu_m.has_value());
  out.home_m(to_array(in.home_enu_m.value_or(Vec3::Zero())));
}

Converted<GateReport> from_idl(const msg::SafetyState& in) {
  Checks checks;
  GateReport out;
  check_header(checks, in.header());
  checks.stamp("caused_by", in.caused_by());
  checks.enumerator("mode", in.mode(), s::MODE_SILENT);
  checks.enumerator("reason", in.reason(), s::REASON_IMAGES);
  checks.enumerator("phase", in.phase(), s::PHASE_TAKING_OFF);
  checks.enumerator("request", in.request(), s::REQUEST_PILOT);
  checks.enumerator("command_result", in.command_result(), s::RESULT_REFUSED_PLACE);
  checks.enumerator("command", in.command(), o::COMMAND_SET_RETURN_PLACE);
  checks.enumerator("mission_end", in.mission_end(), s::END_LINK);
  checks.enumerator("asked", in.asked(), s::REQUEST_PILOT);
  checks.enumerator("answer", in.answer(), s::ANSWER_CANCELLED);
  checks.within("lease_remaining_s", in.lease_remaining_s(), 1e10);
  checks.within("plan_age_s", in.plan_age_s(), 1e10);
  checks.within("deviation_m", in.deviation_m(), limits::kPosition_m);
  checks.within("odometry_age_s", in.odometry_age_s(), 1e10);
  GateResult& r = out.result;
  if (in.setpoint_valid()) r.setpoint = read_setpoint(checks, in);
  r.person = {in.chosen(), in.person_id()};
  r.framing = read_framing(checks, in.framing());
  r.bounds = read_bounds(checks, in);
  if (in.home_known()) {
    checks.within("home_m", in.home_m(), limits::kPosition_m);
    out.home_enu_m = to_vec3(in.home_m());
  }
  out.stamp_s = seconds(in.header().stamp());
  out.caused_by_s = seconds(in.caused_by());
  out.odometry_age_s = in.odometry_age_s();
  out.order = static_cast<MissionOrder>(in.command());
  out.operator_name = in.operator_id().c_str();
  out.lease_operator = in.lease_operator().c_str();
  out.lease_remaining_s = in.lease_remaining_s();
  out.autopilot.offboard = in.offboard();
  out.autopilot.armed = in.armed();
  r.mode = static_cast<SafetyMode>(in.mode());
  r.reason = static_cast<SafetyReason>(in.reason());
  r.phase = static_cast<MissionPhase>(in.phase());
  r.request = static_cast<AutopilotRequest>(in.request());
  r.command_result = static_cast<MissionResult>(in.command_result());
  r.command_id = in.command_id();
  r.end = static_cast<MissionEnd>(in.mission_end());
  r.asked = static_cast<AutopilotRequest>(in.asked());
  r.answer = static_cast<CommandResult>(in.answer());
  out.dry_run = in.dry_run();
  out.alarm = in.alarm().c_str();
  r.heartbeat = in.heartbeat();
  r.plan_age_s = in.plan_age_s();
  r.deviation_m = in.deviation_m();
  r.plan_id = in.trajectory_id();
  return checks.result(std::move(out));
}

}  // namespace foretrack
