// SPDX-License-Identifier: Apache-2.0
// What an operator may order, who may order it, and where the mission stands.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/common/moving_body.hpp"
#include "core/common/short_text.hpp"
#include "core/safety/flight_bounds.hpp"
#include "core/safety/framing_limits.hpp"

namespace foretrack {

/// What an operator may order.
enum class MissionOrder : std::uint8_t {
  kStart,  // follow; asks the flight controller for arming and offboard mode where needed
  kHold,
  kResume,
  kReturn,
  kLand,
  kStop,
  kLease,    // take the vehicle, or keep it
  kRelease,  // give it back
  kTakeOff,  // by the flight controller, which then holds
  kSetBounds,
  kFollow,          // a person, or nobody
  kSetFraming,      // from where they are to be seen
  kSetReturnPlace,  // which the flight controller keeps
};

/// An order, with who gave it and when.
struct MissionCommand {
  std::uint64_t id = 0;  // orders of one stamp: the later has the higher one
  double stamp_s = 0.0;  // when it was given
  MissionOrder order = MissionOrder::kStart;
  ShortText operator_name = {};  // who gave it
  ShortText lease_id = {};       // the lease under which it is given
  bool proved = false;           // the caller saw the proof that it comes from that lease's holder
  FlightBounds bounds = {};      // of kSetBounds
  std::uint32_t person_id = 0;   // of kFollow: a number of bodies; 0: nobody
  Framing framing = {};          // of kSetFraming
  FlightBounds::Corner return_place_enu_m = {};  // of kSetReturnPlace
};

/// Whom an operator said to follow.
struct PersonChoice {
  bool made = false;            // else perception chooses
  std::uint32_t person_id = 0;  // a number of bodies; 0: nobody
  bool operator==(const PersonChoice&) const = default;
};

/// Who may give orders. It runs out unless its holder renews it, so that a vehicle whose operator
/// is gone can be taken over.
struct MissionLease {
  ShortText id;  // empty: nobody holds it
  ShortText operator_name;
  double until_s = -1e9;  // monotonic clock

  bool is_held(double now_s) const { return !id.empty() && now_s < until_s; }
};

/// Where the mission stands: the orders move it from one to the next.
enum class MissionPhase : std::uint8_t {
  kIdle,
  kTracking,
  kHolding,
  kReturning,  // the flight controller does, as in landing and take-off
  kLanding,
  kStopped,
  kStarting,  // waits for target, map and plan, then for the flight controller's consent
  kTakingOff,
};

/// What became of an order.
enum class MissionResult : std::uint8_t {
  kNone,
  kAccepted,
  kRefusedLate,
  kRefusedRepeated,
  kRefusedPhase,
  kRefusedForeign,  // somebody else holds the lease
  kRefusedFuture,   // stamped ahead of our clock
  kRefusedUnproved,
  kRefusedUnwritten,   // it must outlive a restart, and could not be written
  kRefusedBounds,      // they are no bounds
  kPending,            // acts already, and is being written
  kAcceptedUnwritten,  // acts, and would not outlive a restart
  kRefusedPerson,      // nobody of that number is there
  kRefusedFraming,     // not safe
  kRefusedPlace,       // outside of the fence
};

/// For logs and displays.
std::string_view to_string(MissionOrder order);
/// For logs and displays.
std::string_view to_string(MissionPhase phase);
/// For logs and displays.
std::string_view to_string(MissionResult result);

/// How long orders and leases count, and what may be ordered.
struct MissionRules {
  double max_age_s = 1.0;  // older commands are refused
  double future_s = 0.5;   // so are those stamped farther ahead
  double lease_s = 5.0;    // a lease lasts that long unless it is renewed
  FramingLimits framing = {};
};

/// The same moment on both clocks: ours, which never jumps, and that of stamps.
struct Moment {
  double now_s = 0.0;        // monotonic
  double stamp_now_s = 0.0;  // the clock that stamps are read from; may be set at any time
};

/// An order's place among all: by stamp, and by id among those of one stamp. So an id that is too
/// high, and a station that counts anew, lock nobody out.
struct OrderMark {
  double stamp_s = -1e18;
  std::uint64_t id = 0;
  // The tool of version 14 takes the generated comparison with 0 for one with a null pointer.
  friend auto operator<=>(const OrderMark&,             // NOLINT(modernize-use-nullptr)
                          const OrderMark&) = default;  // NOLINT(modernize-use-nullptr)
};

/// The mission as commands find it.
struct Mission {
  MissionPhase phase = MissionPhase::kIdle;
  bool engaged = false;  // the flight controller has let us fly, and has not taken it back
  MissionLease lease = {};
  OrderMark last_order = {};
  FlightBounds bounds = {};
  PersonChoice person = {};
  Framing framing = {};
};

/// Applies the command and says whether it was taken.
/// Stop is taken from anybody, always. Land is never refused for its id, age or phase, and return
/// only while landing: both from the lease's holder, or from anybody while nobody holds one. The
/// rest must also be newer than what came before, and fit the phase; settings are made under a
/// lease alone. `bodies`: who is there to be followed; null: nobody.
MissionResult apply(const MissionCommand& command, Mission& mission, const Moment& moment,
                    const MissionRules& rules, const MovingBodies* bodies = nullptr);

/// It acts; whether it would outlive a restart is another question.
constexpr bool is_accepted(MissionResult result) {
  return result == MissionResult::kAccepted || result == MissionResult::kPending ||
         result == MissionResult::kAcceptedUnwritten;
}

/// Bounds, whom to follow, framing, the place to return to: they outlive who ordered them, and
/// change no phase.
constexpr bool is_setting(MissionOrder order) {
  return order == MissionOrder::kSetBounds || order == MissionOrder::kFollow ||
         order == MissionOrder::kSetFraming || order == MissionOrder::kSetReturnPlace;
}

/// Must outlive a restart, so that it is refused when it cannot be written.
bool needs_memory(MissionOrder order);

/// The phases in which setpoints may be flown, or will be.
bool is_active(MissionPhase phase);

}  // namespace foretrack
