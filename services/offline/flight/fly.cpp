// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/fly.hpp"

namespace foretrack {

MetricParams metric_params_of(const TrackerParams& params) {
  const PlanningParams& p = params.planning;
  return {.band_low_m = p.place.distance_low_m,
          .band_high_m = p.place.distance_high_m,
          .speed_max_m_s = p.limits.speed_max_m_s,
          .acceleration_max_m_s2 = p.limits.acceleration_max_m_s2,
          .yaw_rate_max_rad_s = p.limits.yaw_rate_max_rad_s,
          .height_above_target_m = p.place.height_above_target_m};
}

FlightResult fly(const Scenario& scenario, const TrackerParams& params,
                 const FlightOptions& options, const TrackerWatch& watch) {
  TrackerPilot tracker(scenario, params);
  const Pilot pilot = [&](PilotStep step) {
    const TrackerOutput out = tracker.fly(step);
    if (watch) watch(out);
  };
  return fly_pilot(scenario, pilot, metric_params_of(params), options);
}

}  // namespace foretrack
