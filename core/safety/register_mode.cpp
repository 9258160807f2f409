// SPDX-License-Identifier: Apache-2.0
#include "core/safety/register_mode.hpp"

#include <array>

namespace foretrack {
namespace {

using State = ModeRegistration::State;

void enter(ModeRegistration& registration, State state, double now_s) {
  registration.state = state;
  registration.since_s = now_s;
}

void take_answer(ModeRegistration& registration, const RegistrationInput& in) {
  if (registration.state != State::kAsked || !in.answer) return;
  registration.numbers = in.answer->numbers;
  enter(registration, in.answer->accepted ? State::kRegistered : State::kRefused, in.now_s);
}

void give_up(ModeRegistration& registration, const RegistrationInput& in) {
  const double since_s = in.now_s - registration.since_s;
  if (registration.state == State::kAsked && since_s > kAnswer_s)
    enter(registration, State::kUnanswered, in.now_s);
  if (registration.state != State::kRegistered || !in.heard || since_s < kShown_s) return;
  const bool shown = (in.selectable >> registration.numbers.mode & 1u) != 0;
  if (!shown) enter(registration, State::kLost, in.now_s);
}

bool may_ask(const ModeRegistration& registration, double now_s) {
  switch (registration.state) {
    case State::kAsked:
    case State::kRegistered:
      return false;
    case State::kRefused:
      return now_s - registration.since_s >= kRefusedFor_s;
    default:
      return true;
  }
}

}  // namespace

bool register_mode(ModeRegistration& registration, const RegistrationInput& in) {
  if (in.now_s < registration.since_s) enter(registration, State::kLost, in.now_s);
  take_answer(registration, in);
  give_up(registration, in);
  if (!in.heard || in.armed || !may_ask(registration, in.now_s)) return false;
  enter(registration, State::kAsked, in.now_s);
  return true;
}

std::string_view to_string(ModeRegistration::State state) {
  constexpr std::array<std::string_view, 6> names = {
      "not yet registered",
      "the flight controller is asked to register it",
      "registered",
      "the flight controller refused to register it",
      "the flight controller did not answer",
      "the flight controller has forgotten it"};
  return names[static_cast<std::size_t>(state)];
}

}  // namespace foretrack
