// SPDX-License-Identifier: Apache-2.0
#include "core/safety/autopilot_watch.hpp"

#include <array>

namespace foretrack {
namespace {

bool is_refusal(CommandResult result) {
  return result != CommandResult::kAccepted && result != CommandResult::kInProgress;
}

// Flight controllers that do not name their modes at least leave offboard.
bool is_in(FlightMode mode, const AutopilotStatus& status) {
  return status.mode == FlightMode::kUnknown ? !status.offboard : status.mode == mode;
}

// The reasons that hold whoever flies.
MissionEnd emergency(const AutopilotStatus& status) {
  if (status.mode == FlightMode::kTermination) return MissionEnd::kTerminated;
  if (status.failsafe) return MissionEnd::kFailsafe;
  if (status.mode == FlightMode::kPilot || status.user_took_over) return MissionEnd::kPilot;
  return status.sticks_moved ? MissionEnd::kSticks : MissionEnd::kNone;
}

// Modes that follow upon what was asked for without anybody choosing them.
bool leads_on(MissionPhase phase, FlightMode mode) {
  switch (phase) {
    case MissionPhase::kReturning:
      return mode == FlightMode::kReturn || mode == FlightMode::kLand;
    case MissionPhase::kLanding:
      return mode == FlightMode::kLand;
    case MissionPhase::kTakingOff:
      return mode == FlightMode::kTakeOff;
    default:
      return mode == FlightMode::kHold;
  }
}

}  // namespace

bool shows(AutopilotRequest request, const AutopilotStatus& status) {
  switch (request) {
    case AutopilotRequest::kArm:
      return status.armed;
    case AutopilotRequest::kOffboard:
      return status.offboard;
    case AutopilotRequest::kReturn:
      return is_in(FlightMode::kReturn, status) || is_in(FlightMode::kLand, status);
    case AutopilotRequest::kLand:
      return is_in(FlightMode::kLand, status) || !status.armed;
    case AutopilotRequest::kTakeOff:
      return is_in(FlightMode::kTakeOff, status);
    default:  // kHold
      return is_in(FlightMode::kHold, status);
  }
}

AskProgress follow(Asking& asking, const AutopilotAck* ack, const AutopilotStatus& status,
                   double now_s, const AskParams& params) {
  if (asking.request == AutopilotRequest::kNone) return {};
  if (shows(asking.request, status)) {
    asking = {};
    return {AskState::kDone};
  }
  MissionEnd why = MissionEnd::kNone;
  if (ack && ack->request == asking.request) {
    asking.accepted = true;
    if (is_refusal(ack->result)) why = MissionEnd::kRefused;
  }
  const double waited_s = now_s - asking.asked_s;
  if (why == MissionEnd::kNone && !asking.accepted && waited_s > params.answer_s)
    why = MissionEnd::kNoAnswer;
  if (why == MissionEnd::kNone && waited_s > params.done_s) why = MissionEnd::kNotDone;
  if (why == MissionEnd::kNone) return {AskState::kWaits};
  asking = {};
  return {AskState::kFailed, why};
}

MissionEnd start_hindrance(const AutopilotStatus& status, FlightMode at_the_order) {
  const MissionEnd end = emergency(status);
  const bool left_alone = status.mode == FlightMode::kPilot && at_the_order == FlightMode::kPilot &&
                          !status.user_took_over;
  if (end != MissionEnd::kPilot || !left_alone) return end;
  return status.sticks_moved ? MissionEnd::kSticks : MissionEnd::kNone;
}

MissionEnd taken_over(const AutopilotStatus& status) {
  if (const MissionEnd end = emergency(status); end != MissionEnd::kNone) return end;
  if (!status.armed) return MissionEnd::kDisarmed;
  return status.offboard ? MissionEnd::kNone : MissionEnd::kOtherMode;
}

MissionEnd delegated_end(MissionPhase phase, const AutopilotStatus& status) {
  if (const MissionEnd end = emergency(status); end != MissionEnd::kNone) return end;
  if (!status.armed) return MissionEnd::kDone;
  if (status.mode == FlightMode::kUnknown || leads_on(phase, status.mode)) return MissionEnd::kNone;
  const bool has_taken_off = phase == MissionPhase::kTakingOff && status.mode == FlightMode::kHold;
  return has_taken_off ? MissionEnd::kDone : MissionEnd::kOtherMode;
}

std::string_view to_string(AutopilotRequest request) {
  constexpr std::array<std::string_view, 9> names = {"nothing",
                                                     "arm",
                                                     "offboard",
                                                     "return",
                                                     "land",
                                                     "take off",
                                                     "hold",
                                                     "another return place",
                                                     "the pilot's position mode"};
  return names[static_cast<std::size_t>(request)];
}
std::string_view to_string(CommandResult result) {
  constexpr std::array<std::string_view, 7> names = {
      "accepted", "temporarily rejected", "denied",   "unsupported",
      "failed",   "in progress",          "cancelled"};
  return names[static_cast<std::size_t>(result)];
}
std::string_view to_string(MissionEnd end) {
  constexpr std::array<std::string_view, 16> names = {
      "",
      "the pilot took over",
      "the pilot moved the sticks",
      "another mode was chosen",
      "the vehicle was disarmed",
      "the flight controller's failsafe acts",
      "the flight was terminated",
      "the flight controller refused",
      "the flight controller did not answer",
      "the flight controller accepted, and did nothing",
      "target, map, plan or flight controller did not come in time",
      "done",
      "the order could not be written, and a restart would forget it",
      "outside of what may be flown in",
      "the battery is at its reserve",
      "no word from the operator"};
  return names[static_cast<std::size_t>(end)];
}

}  // namespace foretrack
