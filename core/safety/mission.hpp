// SPDX-License-Identifier: Apache-2.0
// What an operator may order, and what the gate asks of the flight controller.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace foretrack {

enum class MissionOrder : std::uint8_t {
  kStart,
  kHold,
  kResume,
  kReturn,
  kLand,
  kStop,
  kLease,    // take the vehicle, or keep it
  kRelease,  // give it back
};

struct MissionCommand {
  std::uint64_t id = 0;  // grows; an id that was seen before is ignored
  double stamp_s = 0.0;  // when it was given
  MissionOrder order = MissionOrder::kStart;
  std::string operator_name = {};  // who gave it
  std::string lease_id = {};       // known to its holder alone
};

/// Who may give orders. It runs out unless its holder renews it, so that a vehicle whose operator
/// is gone can be taken over.
struct MissionLease {
  std::string id;  // empty: nobody holds it
  std::string operator_name;
  double until_s = -1e9;

  bool is_held(double now_s) const { return !id.empty() && now_s < until_s; }
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
  kRefusedPhase,
  kRefusedForeign  // somebody else holds the lease
};

enum class AutopilotRequest : std::uint8_t { kNone, kArm, kOffboard, kReturn, kLand };

std::string_view to_string(MissionOrder order);
std::string_view to_string(MissionPhase phase);
std::string_view to_string(MissionResult result);

struct MissionRules {
  double max_age_s = 1.0;  // older commands are refused
  double lease_s = 5.0;    // a lease lasts that long unless it is renewed
};

/// The mission as commands find it.
struct Mission {
  MissionPhase phase = MissionPhase::kIdle;
  MissionLease lease;
  std::uint64_t last_id = 0;  // the highest that was seen
};

/// Applies the command and says whether it was taken. Stop is always taken, however late and from
/// whomever; a stopped mission takes only start, return and land. While somebody holds the lease,
/// orders of others are refused; while nobody does, anybody may order.
MissionResult apply(const MissionCommand& command, Mission& mission, double now_s,
                    const MissionRules& rules);

}  // namespace foretrack
