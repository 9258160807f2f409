// SPDX-License-Identifier: Apache-2.0
// The room that a plan needs around it, by its speed: narrow ways are flown slower.
#pragma once

#include "core/common/deviation_bound.hpp"

namespace foretrack {

struct PlanningParams;

/// The vehicle's hull, what it leaves its plans by, and the map's own error; never less than the
/// check asks of every plan. A plan that is no faster than slow_m_s needs no room for the map's
/// error: so slowly, every way that the check allows is flown before it is given up.
struct Tube {
  double hull_m = 0.25;
  double map_error_m = 0.075;
  double least_m = 0.35;
  double slow_m_s = 0.5;
  DeviationBound deviation;

  /// From the plan to what is not free.
  double radius_m(double speed_m_s, double acceleration_m_s2) const;
  /// The same, however the plan accelerates.
  double radius_m(double speed_m_s) const;
  /// The greatest speed whose tube is no wider, however the plan accelerates; at least slow_m_s.
  double speed_within_m_s(double radius_m) const;
};

/// As the parameters, the map's cells and the measured vehicle have it.
Tube make_tube(const PlanningParams& params, double resolution_m, const DeviationBound& deviation);

}  // namespace foretrack
