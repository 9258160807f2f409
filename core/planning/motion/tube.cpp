// SPDX-License-Identifier: Apache-2.0
#include "core/planning/motion/tube.hpp"

#include <algorithm>

#include "core/planning/plan_params.hpp"

namespace foretrack {
namespace {

double around_m(const Tube& tube, double speed_m_s, double bound_m) {
  const double error_m = speed_m_s > tube.slow_m_s ? tube.map_error_m : 0.0;
  return std::max(tube.least_m, tube.hull_m + bound_m + error_m);
}

}  // namespace

double Tube::radius_m(double speed_m_s, double acceleration_m_s2) const {
  return around_m(*this, speed_m_s, deviation.bound_m(speed_m_s, acceleration_m_s2));
}

double Tube::radius_m(double speed_m_s) const {
  return around_m(*this, speed_m_s, deviation.bound_m(speed_m_s));
}

double Tube::speed_within_m_s(double radius_m) const {
  return std::max(slow_m_s, deviation.speed_within_m_s(radius_m - hull_m - map_error_m));
}

Tube make_tube(const PlanningParams& params, double resolution_m, const DeviationBound& deviation) {
  return {params.body.hull_radius_m, 0.5 * resolution_m, params.check.vehicle_radius_m,
          params.place.narrow_speed_m_s, deviation};
}

}  // namespace foretrack
