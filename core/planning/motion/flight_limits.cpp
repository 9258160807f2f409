// SPDX-License-Identifier: Apache-2.0
#include "core/planning/motion/flight_limits.hpp"

namespace foretrack {

ParamRows rows(FlightLimits& p) {
  return {
      {"speed_max_m_s", &p.speed_max_m_s, "m/s", 0.1, 20.0, "greatest speed"},
      {"acceleration_max_m_s2", &p.acceleration_max_m_s2, "m/s2", 0.1, 20.0,
       "greatest acceleration"},
      {"yaw_rate_max_rad_s", &p.yaw_rate_max_rad_s, "rad/s", 0.1, 10.0, "greatest yaw rate"},
      {"yaw_acceleration_max_rad_s2", &p.yaw_acceleration_max_rad_s2, "rad/s2", 0.1, 50.0,
       "greatest yaw acceleration"},
  };
}

}  // namespace foretrack
