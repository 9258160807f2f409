// What an operator may order, and what the gate asks of the flight controller.
#pragma once

#include <cstdint>
#include <string_view>

namespace foretrack {

enum class MissionOrder : std::uint8_t { kStart, kHold, kResume, kReturn, kLand, kStop };

struct MissionCommand {
  std::uint64_t id = 0;  // grows; an id that was seen before is ignored
  double stamp_s = 0.0;  // when it was given
  MissionOrder order = MissionOrder::kStart;
};

/// Where the mission stands: the orders move it from one to the next.
enum class MissionPhase : std::uint8_t {
  kIdle,
  kTracking,
  kHolding,
  kReturning,
  kLanding,
  kStopped
};

enum class MissionResult : std::uint8_t {
  kNone,
  kAccepted,
  kRefusedLate,
  kRefusedRepeated,
  kRefusedPhase
};

enum class AutopilotRequest : std::uint8_t { kNone, kArm, kOffboard, kReturn, kLand };

std::string_view to_string(MissionOrder order);
std::string_view to_string(MissionPhase phase);
std::string_view to_string(MissionResult result);

/// The phase after the command, and whether it was taken. Stop is always taken, however late; a
/// stopped mission takes only start, return and land.
struct MissionTransition {
  MissionPhase phase;
  MissionResult result;
};
MissionTransition apply(const MissionCommand& command, MissionPhase phase, std::uint64_t last_id,
                        double now_s, double max_age_s);

}  // namespace foretrack
