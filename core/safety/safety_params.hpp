// SPDX-License-Identifier: Apache-2.0
// Parameters of the gate.
#pragma once

#include "core/common/params.hpp"
#include "core/safety/carry_out.hpp"

namespace foretrack {

struct SafetyParams {
  // ages, by arrival
  double plan_fresh_s = 0.25;
  double hover_limit_s = 5.0;
  double vehicle_stale_s = 0.3;
  double autopilot_stale_s = 2.0;
  // flight
  double max_deviation_m = 1.0;
  double brake_done_m_s = 0.2;
  double response_s = 0.1;
  // orders
  double command_max_age_s = 1.0;
  double command_future_s = 0.5;
  double lease_s = 5.0;
  // the flight controller
  double answer_s = 1.5;
  double done_s = 4.0;
  double heartbeat_before_s = 1.0;
  double start_patience_s = 30.0;

  MissionRules mission_rules() const { return {command_max_age_s, command_future_s, lease_s}; }
  CarryOutParams carry_out() const {
    return {{answer_s, done_s}, heartbeat_before_s, start_patience_s};
  }
};
ParamRows rows(SafetyParams& params);

}  // namespace foretrack
