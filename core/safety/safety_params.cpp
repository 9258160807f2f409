// SPDX-License-Identifier: Apache-2.0
#include "core/safety/safety_params.hpp"

namespace foretrack {

ParamRows rows(SafetyParams& p) {
  return {
      {"plan_fresh_s", &p.plan_fresh_s, "s", 0.05, 2.0, "a plan older than this coasts"},
      {"hover_limit_s", &p.hover_limit_s, "s", 0.5, 60.0,
       "without any plan for this long the heartbeat stops"},
      {"vehicle_stale_s", &p.vehicle_stale_s, "s", 0.05, 2.0, "oldest vehicle state to act on"},
      {"autopilot_stale_s", &p.autopilot_stale_s, "s", 0.1, 10.0,
       "longest silence of the flight controller"},
      {"max_deviation_m", &p.max_deviation_m, "m", 0.2, 5.0,
       "farther than this from the flown trajectory: brake"},
      {"brake_done_m_s", &p.brake_done_m_s, "m/s", 0.05, 1.0,
       "below this speed a position is held"},
      {"response_s", &p.response_s, "s", 0.0, 1.0,
       "time in which the vehicle's tilt follows; accelerations are commanded so much ahead"},
      {"command_max_age_s", &p.command_max_age_s, "s", 0.1, 10.0, "older commands are refused"},
      {"command_future_s", &p.command_future_s, "s", 0.0, 10.0,
       "commands stamped farther ahead are refused"},
      {"lease_s", &p.lease_s, "s", 1.0, 60.0,
       "an operator's lease ends that long after it was last renewed"},
      {"answer_s", &p.answer_s, "s", 0.1, 10.0,
       "a request that the flight controller does not answer for so long is given up"},
      {"done_s", &p.done_s, "s", 0.5, 30.0,
       "so is one that it accepted, but does not do for so long"},
      {"heartbeat_before_s", &p.heartbeat_before_s, "s", 0.0, 5.0,
       "unbroken heartbeat before offboard mode is asked for"},
      {"start_patience_s", &p.start_patience_s, "s", 1.0, 600.0,
       "an order to start ends that long after it, unless target, map and plan have come"},
  };
}

}  // namespace foretrack
