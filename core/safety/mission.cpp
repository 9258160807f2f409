#include "core/safety/mission.hpp"

#include <array>

namespace foretrack {
namespace {

MissionTransition move_to(MissionPhase phase) {
  return {phase, MissionResult::kAccepted};
}

bool is_allowed(MissionOrder order, MissionPhase phase) {
  switch (order) {
    case MissionOrder::kStart:
      return phase == MissionPhase::kIdle || phase == MissionPhase::kStopped;
    case MissionOrder::kHold:
      return phase == MissionPhase::kTracking || phase == MissionPhase::kReturning;
    case MissionOrder::kResume:
      return phase == MissionPhase::kHolding;
    case MissionOrder::kReturn:
    case MissionOrder::kLand:
      return phase != MissionPhase::kLanding;
    case MissionOrder::kStop:
      return true;
  }
  return false;
}

}  // namespace

MissionTransition apply(const MissionCommand& command, MissionPhase phase, std::uint64_t last_id,
                        double now_s, double max_age_s) {
  if (command.order == MissionOrder::kStop) return move_to(MissionPhase::kStopped);
  if (command.id <= last_id) return {phase, MissionResult::kRefusedRepeated};
  if (now_s - command.stamp_s > max_age_s) return {phase, MissionResult::kRefusedLate};
  if (!is_allowed(command.order, phase)) return {phase, MissionResult::kRefusedPhase};
  switch (command.order) {
    case MissionOrder::kHold:
      return move_to(MissionPhase::kHolding);
    case MissionOrder::kReturn:
      return move_to(MissionPhase::kReturning);
    case MissionOrder::kLand:
      return move_to(MissionPhase::kLanding);
    default:
      return move_to(MissionPhase::kTracking);
  }
}

std::string_view to_string(MissionOrder order) {
  constexpr std::array<std::string_view, 6> names = {"start",  "hold", "resume",
                                                     "return", "land", "stop"};
  return names.at(static_cast<std::size_t>(order));
}
std::string_view to_string(MissionPhase phase) {
  constexpr std::array<std::string_view, 6> names = {"idle",      "tracking", "holding",
                                                     "returning", "landing",  "stopped"};
  return names.at(static_cast<std::size_t>(phase));
}
std::string_view to_string(MissionResult result) {
  constexpr std::array<std::string_view, 5> names = {
      "none", "accepted", "refused: too late", "refused: repeated", "refused: not in this phase"};
  return names.at(static_cast<std::size_t>(result));
}

}  // namespace foretrack
