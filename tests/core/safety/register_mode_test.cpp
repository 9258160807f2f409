// SPDX-License-Identifier: Apache-2.0
#include "core/safety/register_mode.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

using State = ModeRegistration::State;

constexpr ModeNumbers kNumbers{23, 1};
constexpr std::uint32_t kShown = 1u << 23;

// Ticks at 10 Hz, and counts how often it is asked.
struct Asker {
  ModeRegistration registration;
  RegistrationInput in{.heard = true, .selectable = kShown};
  int asked = 0;

  void run(double for_s) {
    for (double t = 0.0; t < for_s; t += 0.1) {
      in.now_s += 0.1;
      asked += register_mode(registration, in);
      in.answer.reset();
    }
  }
  void answer(bool accepted) {
    in.answer = RegistrationAnswer{accepted, kNumbers};
    run(0.05);
  }
};

TEST(RegisterMode, AsksOnceAndIsRegisteredByTheAnswer) {
  Asker asker;
  asker.run(1.0);
  EXPECT_EQ(asker.asked, 1);
  asker.answer(true);
  asker.run(60.0);
  EXPECT_EQ(asker.registration.state, State::kRegistered);
  EXPECT_EQ(asker.registration.numbers.mode, 23);
  EXPECT_EQ(asker.asked, 1);
}

TEST(RegisterMode, WaitsForTheFlightControllerAndAsksAgainWithoutAnAnswer) {
  Asker asker;
  asker.in.heard = false;
  asker.run(30.0);
  EXPECT_EQ(asker.asked, 0);
  asker.in.heard = true;
  asker.run(kAnswer_s - 0.5);
  EXPECT_EQ(asker.asked, 1) << "it may have registered the mode, and forgets it by itself";
  asker.run(1.0);
  EXPECT_EQ(asker.asked, 2);
}

TEST(RegisterMode, AsksNothingOfAnArmedVehicleWhichWouldRefuse) {
  Asker asker;
  asker.in.armed = true;
  asker.run(30.0);
  EXPECT_EQ(asker.asked, 0);
  asker.in.armed = false;
  asker.run(0.5);
  EXPECT_EQ(asker.asked, 1);
}

TEST(RegisterMode, ARefusalIsAskedAboutAgainLater) {
  Asker asker;
  asker.run(0.5);
  asker.answer(false);
  EXPECT_EQ(asker.registration.state, State::kRefused);
  asker.run(kRefusedFor_s - 1.0);
  EXPECT_EQ(asker.asked, 1);
  asker.run(2.0);
  EXPECT_EQ(asker.asked, 2);
}

TEST(RegisterMode, AFlightControllerThatWasRestartedIsAskedAnew) {
  Asker asker;
  asker.run(0.5);
  asker.answer(true);
  asker.run(kShown_s + 1.0);
  asker.in.heard = false;
  asker.in.selectable = 0;
  asker.run(20.0);
  EXPECT_EQ(asker.registration.state, State::kRegistered) << "its agent may be away";
  asker.in.heard = true;
  asker.run(0.5);
  EXPECT_EQ(asker.registration.state, State::kAsked);
  EXPECT_EQ(asker.asked, 2);
}

TEST(RegisterMode, InASimulationThatBeganAnewItIsAskedAnew) {
  Asker asker;
  asker.in.now_s = 400.0;
  asker.run(0.5);
  asker.answer(true);
  asker.in.now_s = 2.0;
  asker.run(0.5);
  EXPECT_EQ(asker.asked, 2);
}

}  // namespace
}  // namespace foretrack
