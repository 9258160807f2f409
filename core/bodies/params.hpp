// SPDX-License-Identifier: Apache-2.0
// The parameters of tracking bodies.
#pragma once

#include "core/common/params.hpp"

namespace foretrack {

/// What each of them means, and its range, is in its row: see rows(), or `foretrack params bodies`.
struct BodyParams {
  double acceleration_density_m2_s3 = 1.0;
  double initial_speed_sigma_m_s = 1.5;
  double gate_mahalanobis = 3.5;
  int birth_hits = 3;
  double birth_gap_s = 0.3;
  double birth_way_m = 0.25;
  double coast_s = 1.5;
  double late_s = 0.5;
  double same_place_m = 0.25;
  double followed_radius_m = 0.25;
};

/// One row for each field: name, unit, range, meaning.
ParamRows rows(BodyParams& p);

}  // namespace foretrack
