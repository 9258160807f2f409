// SPDX-License-Identifier: Apache-2.0
#include "services/convert/px4_command.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "services/convert/px4_time.hpp"

namespace foretrack {
namespace {

namespace msg = px4_msgs::msg;
namespace number = msg::VehicleCommand_Constants;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint8_t kAutopilotComponent = 1;
constexpr std::uint16_t kOnboardComputer = 191;  // MAV_COMP_ID_ONBOARD_COMPUTER
constexpr double kMaxStamp_s = 1e10;

constexpr float kCustomModeEnabled = 1.0f;  // of VEHICLE_CMD_DO_SET_MODE
constexpr float kAutoMainMode = 4.0f;       // PX4_CUSTOM_MAIN_MODE_AUTO
constexpr float kOffboardMainMode = 6.0f;   // PX4_CUSTOM_MAIN_MODE_OFFBOARD
constexpr float kPositionMainMode = 3.0f;   // PX4_CUSTOM_MAIN_MODE_POSCTL
constexpr float kLoiterSubMode = 3.0f;      // PX4_CUSTOM_SUB_MODE_AUTO_LOITER
constexpr float kForced = 21196.0f;         // of VEHICLE_CMD_COMPONENT_ARM_DISARM

void set_mode(FlightMode mode, msg::VehicleCommand& out) {
  switch (mode) {
    case FlightMode::kReturn:
      return out.command(number::VEHICLE_CMD_NAV_RETURN_TO_LAUNCH);
    case FlightMode::kLand:
      return out.command(number::VEHICLE_CMD_NAV_LAND);
    case FlightMode::kTakeOff:  // where it stands, to the height that it is set to
      out.command(number::VEHICLE_CMD_NAV_TAKEOFF);
      out.param4(kNaN);
      out.param5(kNaN);
      out.param6(kNaN);
      return out.param7(kNaN);
    case FlightMode::kOffboard:
      out.param2(kOffboardMainMode);
      break;
    case FlightMode::kPilot:
      out.param2(kPositionMainMode);
      break;
    default:
      out.param2(kAutoMainMode);
      out.param3(kLoiterSubMode);
      break;
  }
  out.command(number::VEHICLE_CMD_DO_SET_MODE);
  out.param1(kCustomModeEnabled);
}

FlightMode mode_of(Checks& checks, const msg::VehicleCommand& in) {
  if (in.param2() == kOffboardMainMode) return FlightMode::kOffboard;
  if (in.param2() == kPositionMainMode) return FlightMode::kPilot;
  if (in.param2() != kAutoMainMode)
    checks.fail("param2", std::to_string(in.param2()), "3 (position), 4 (auto) or 6 (offboard)");
  else if (in.param3() != kLoiterSubMode)
    checks.fail("param3", std::to_string(in.param3()), "3 (loiter)");
  return FlightMode::kHold;
}

}  // namespace

void to_idl(const AutopilotCommand& in, double stamp_s, msg::VehicleCommand& out) {
  out = {};
  out.timestamp(microseconds(stamp_s));
  out.target_system(static_cast<std::uint8_t>(in.target_system));
  out.target_component(kAutopilotComponent);
  out.source_system(static_cast<std::uint8_t>(in.target_system));
  out.source_component(kOnboardComputer);
  out.from_external(true);
  if (in.kind == CommandKind::kMode) return set_mode(in.mode, out);
  out.command(number::VEHICLE_CMD_COMPONENT_ARM_DISARM);
  out.param1(in.kind == CommandKind::kArm ? 1.0f : 0.0f);
  out.param2(in.forced ? kForced : 0.0f);
}

Converted<AutopilotCommand> from_idl(const msg::VehicleCommand& in) {
  Checks checks;
  checks.in_range("timestamp", 1e-6 * static_cast<double>(in.timestamp()), 0.0, kMaxStamp_s);
  AutopilotCommand out;
  out.target_system = in.target_system();
  switch (in.command()) {
    case number::VEHICLE_CMD_COMPONENT_ARM_DISARM:
      if (in.param1() != 1.0f && in.param1() != 0.0f)
        checks.fail("param1", std::to_string(in.param1()), "1 (arm) or 0 (disarm)");
      out.kind = in.param1() == 1.0f ? CommandKind::kArm : CommandKind::kDisarm;
      out.forced = in.param2() == kForced;
      break;
    case number::VEHICLE_CMD_DO_SET_MODE:
      out.mode = mode_of(checks, in);
      break;
    case number::VEHICLE_CMD_NAV_RETURN_TO_LAUNCH:
      out.mode = FlightMode::kReturn;
      break;
    case number::VEHICLE_CMD_NAV_LAND:
      out.mode = FlightMode::kLand;
      break;
    case number::VEHICLE_CMD_NAV_TAKEOFF:
      out.mode = FlightMode::kTakeOff;
      break;
    default:
      checks.fail("command", std::to_string(in.command()), "20, 21, 22, 176 or 400");
  }
  return checks.result(out);
}

void to_ack(const msg::VehicleCommand& command, CommandResult result, double stamp_s,
            msg::VehicleCommandAck& out) {
  out = {};
  out.timestamp(microseconds(stamp_s));
  out.command(command.command());
  out.result(static_cast<std::uint8_t>(result));
  out.target_system(command.source_system());
  out.target_component(command.source_component());
}

bool answers(const msg::VehicleCommandAck& ack, const msg::VehicleCommand& command) {
  return ack.command() == command.command() && ack.target_system() == command.source_system() &&
         ack.target_component() == command.source_component();
}

CommandResult result_of(const msg::VehicleCommandAck& ack) {
  return ack.result() <= static_cast<std::uint8_t>(CommandResult::kCancelled)
             ? static_cast<CommandResult>(ack.result())
             : CommandResult::kFailed;
}

}  // namespace foretrack
