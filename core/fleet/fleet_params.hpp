// SPDX-License-Identifier: Apache-2.0
// The parameters of a fleet's coordination.
#pragma once

#include "core/common/params.hpp"

namespace foretrack {

/// Ranges are in the rows: see rows(), or `foretrack params fleet`.
struct FleetParams {
  double silent_s = 1.0;
  double forget_s = 10.0;
  double near_m = 2.0;
  double far_m = 3.5;
  double far_least_m = 2.6;
  double separation_m = 1.0;
  double yield_m = 0.3;
  double downwash_m = 2.0;
  double growth_m_s = 1.0;
  double growth_max_m = 2.5;
  double gate_mahalanobis = 4.0;
  double liar_s = 1.0;
  double align_memory_s = 20.0;
  double align_yaw_rad = 0.1;
  double align_position_m = 0.3;
  double look_ahead_s = 2.5;
  double speed_m_s = 2.5;
  double way_weight_per_s = 0.02;
  double keep_weight = 0.04;
  double occlusion_weight = 0.3;
  double picture_weight = 0.02;
  double spacing_weight = 0.05;
  bool by_intention = true;
  bool directions = true;
};

/// One row for each field: name, unit, range, meaning.
ParamRows rows(FleetParams& p);

}  // namespace foretrack
