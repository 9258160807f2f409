// SPDX-License-Identifier: Apache-2.0
// Registering a mode with the flight controller: until it is there, again when it was restarted,
// and never while it is armed, when it would refuse.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace foretrack {

/// What the flight controller calls the mode and its arming check.
struct ModeNumbers {
  int mode = -1;   // as in its status
  int check = -1;  // by which it asks whether the mode may run
};

/// Its answer.
struct RegistrationAnswer {
  bool accepted = false;
  ModeNumbers numbers;
};

/// How far it is.
struct ModeRegistration {
  enum class State : std::uint8_t {
    kUnasked,
    kAsked,
    kRegistered,
    kRefused,
    kUnanswered,
    kLost,  // it was registered, and is not any more
  };
  State state = State::kUnasked;
  ModeNumbers numbers;     // of kRegistered
  double since_s = -1e18;  // when it was asked, or registered
};
/// For logs and displays.
std::string_view to_string(ModeRegistration::State state);

/// What one tick goes by.
struct RegistrationInput {
  double now_s = 0.0;
  bool heard = false;  // the flight controller, of late
  bool armed = false;
  std::uint32_t selectable = 0;  // modes that can be selected, a bit each, as its status says
  std::optional<RegistrationAnswer> answer = {};
};

/// One without an answer may have registered the mode: the flight controller forgets it after 3 s
/// without a word of ours, and two of one name are none too good.
inline constexpr double kAnswer_s = 5.0;
inline constexpr double kRefusedFor_s = 10.0;  // before it is asked again
inline constexpr double kShown_s = 2.0;        // in which its status shows what it registered

/// One tick. True: it is to be asked now. Where time falls, a simulation was started anew.
bool register_mode(ModeRegistration& registration, const RegistrationInput& input);

}  // namespace foretrack
