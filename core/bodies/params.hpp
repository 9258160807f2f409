// SPDX-License-Identifier: Apache-2.0
// The parameters of tracking bodies.
#pragma once

#include "core/common/params.hpp"

namespace foretrack {

/// Ranges are in the rows: see rows(), or `foretrack params bodies`.
struct BodyParams {
  double acceleration_density_m2_s3 = 1.0;  ///< white acceleration of a body
  double initial_speed_sigma_m_s = 1.5;     ///< of a body that is seen for the first time
  /// a sighting farther from where a body is expected is of another one
  double gate_mahalanobis = 3.5;
  int birth_hits = 3;               ///< sightings after which a body is believed
  double birth_gap_s = 0.3;         ///< and no longer between two of them
  double birth_way_m = 0.25;        ///< way after which something that moves is believed
  double coast_s = 1.5;             ///< a body that is not seen for longer is forgotten
  double late_s = 0.5;              ///< frames later than this are not used
  double same_place_m = 0.25;       ///< two bodies this near are one
  double followed_radius_m = 0.25;  ///< of the person who is followed
};

/// One row for each field: name, unit, range, meaning.
ParamRows rows(BodyParams& p);

}  // namespace foretrack
