// SPDX-License-Identifier: Apache-2.0
// The gate's talk with the flight controller: what is asked, what is answered, and who takes over.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/common/vehicle.hpp"
#include "core/safety/mission.hpp"

namespace foretrack {

/// kHold: loiter where it is. kHome: to return to another place. kPilot: the pilot's position mode.
enum class AutopilotRequest : std::uint8_t {
  kNone,
  kArm,
  kOffboard,
  kReturn,
  kLand,
  kTakeOff,
  kHold,
  kHome,
  kPilot
};

/// The flight controller's answer to a request.
struct AutopilotAck {
  AutopilotRequest request = AutopilotRequest::kNone;
  CommandResult result = CommandResult::kAccepted;
};

/// Why a mission came to its end, or an order to nothing.
enum class MissionEnd : std::uint8_t {
  kNone,
  kPilot,      // took over
  kSticks,     // the pilot moved them
  kOtherMode,  // somebody chose another mode
  kDisarmed,
  kFailsafe,  // the flight controller's own
  kTerminated,
  kRefused,  // the flight controller's answer to what was asked
  kNoAnswer,
  kNotDone,    // it accepted, and then did not
  kNotReady,   // target, map, plan or flight controller did not come in time
  kDone,       // it has landed, or taken off
  kUnwritten,  // the order could not be remembered
  kFence,
  kBattery,
  kLink,
};

/// For logs and displays.
std::string_view to_string(AutopilotRequest request);
/// For logs and displays.
std::string_view to_string(CommandResult result);
/// For logs and displays.
std::string_view to_string(MissionEnd end);

/// One request that was made, until it is seen to be done. It is never repeated.
struct Asking {
  AutopilotRequest request = AutopilotRequest::kNone;  // kNone: nothing is asked
  double asked_s = 0.0;
  bool accepted = false;
};

/// How far a request is.
enum class AskState : std::uint8_t { kNothing, kWaits, kDone, kFailed };

/// How long an answer, and then the deed, are waited for.
struct AskParams {
  double answer_s = 1.5;  // no answer for so long: it is given up
  double done_s = 4.0;    // accepted, but not seen to be done for so long: the same
};

/// How far a request is, and why it failed.
struct AskProgress {
  AskState state = AskState::kNothing;
  MissionEnd why = MissionEnd::kNone;  // of kFailed
};

/// Follows the request: done as soon as the status shows it, whatever was answered.
AskProgress follow(Asking& asking, const AutopilotAck* ack, const AutopilotStatus& status,
                   double now_s, const AskParams& params);

/// The status shows what was asked for. Precondition: something was.
bool shows(AutopilotRequest request, const AutopilotStatus& status);

/// What forbids to ask for the vehicle, after an order to start that came in another mode: kNone,
/// nothing. A vehicle that a pilot had left to hold by itself may be asked for.
MissionEnd start_hindrance(const AutopilotStatus& status, FlightMode at_the_order);

/// Somebody or something else has taken the vehicle since it was let to us: kNone, nobody has.
MissionEnd taken_over(const AutopilotStatus& status);

/// The same while the flight controller does by itself what it was asked for. kDone: it has.
MissionEnd delegated_end(MissionPhase phase, const AutopilotStatus& status);

}  // namespace foretrack
