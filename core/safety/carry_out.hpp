// SPDX-License-Identifier: Apache-2.0
// Carrying out a mission's phase with the flight controller. Whatever is asked of it, is asked once
// for an operator's order; whoever takes the vehicle keeps it until a new one.
#pragma once

#include "core/safety/autopilot_watch.hpp"

namespace foretrack {

/// How patient the gate is with the flight controller.
struct CarryOutParams {
  AskParams ask;
  double heartbeat_before_s = 1.2;  // unbroken, before offboard is asked for
  double patience_s = 30.0;         // for target, map and plan after an order to start
};

/// What one tick of a phase goes by.
struct CarryOutInput {
  double now_s = 0.0;
  AutopilotStatus status;
  const AutopilotAck* ack = nullptr;
  bool ready = false;  // there is a target, a map, a fresh plan, and nothing forbids it
  double heartbeat_since_s = 1e18;  // since when it has been unbroken
};

/// Another place to return to, as it was ordered.
struct HomeAsking {
  FlightBounds::Corner place_enu_m;
  bool is_wanted = false;  // and not yet asked for
  double asked_s = -1.0;   // < 0: no answer is waited for
};

/// What was asked of the flight controller since the last order, and what became of it.
struct CarryOut {
  Asking asking;
  bool asked_arm = false, asked_offboard = false, asked_other = false;  // since the order
  bool delegated = false;  // the flight controller does what it was asked for
  bool by_itself = false;  // and has flown by itself at our request ever since it had the vehicle
  bool offboard_may_come = false;  // it was asked for just before the order
  double since_s = 0.0;            // the order
  FlightMode mode_at_order = FlightMode::kUnknown;
  MissionEnd end = MissionEnd::kNone;                // of the last mission, until the next order
  AutopilotRequest asked = AutopilotRequest::kNone;  // the last request
  CommandResult answer = CommandResult::kAccepted;   // to it
};

/// After an order that has changed the phase.
void begin_phase(CarryOut& state, double now_s, const AutopilotStatus& status);

/// One tick, with a status that is fresh. Moves the phase on; returns what is to be asked now.
AutopilotRequest carry_out(CarryOut& state, Mission& mission, const CarryOutInput& input,
                           const CarryOutParams& params);

/// The same of the place to return to, which changes no phase: asked for once, between two requests
/// of a phase. No answer in time is a failure.
AutopilotRequest ask_for_home(HomeAsking& home, CarryOut& state, const CarryOutInput& input,
                              const CarryOutParams& params);

/// Whoever has the vehicle keeps it. The mission is idle; a stopped one stays stopped.
void end_mission(CarryOut& state, Mission& mission, MissionEnd why);

/// As end_mission(), but what is still flown by us holds its place until the next order.
void hold_mission(CarryOut& state, Mission& mission, MissionEnd why);

}  // namespace foretrack
