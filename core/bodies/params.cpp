// SPDX-License-Identifier: Apache-2.0
#include "core/bodies/params.hpp"

namespace foretrack {

ParamRows rows(BodyParams& p) {
  return {
      {"acceleration_density_m2_s3", &p.acceleration_density_m2_s3, "m2/s3", 0.01, 100.0,
       "white acceleration of a body"},
      {"initial_speed_sigma_m_s", &p.initial_speed_sigma_m_s, "m/s", 0.1, 10.0,
       "of a body that is seen for the first time"},
      {"gate_mahalanobis", &p.gate_mahalanobis, "1", 1.0, 10.0,
       "a sighting farther from where a body is expected is of another one"},
      {"birth_hits", &p.birth_hits, "1", 1, 20, "sightings after which a body is believed"},
      {"birth_gap_s", &p.birth_gap_s, "s", 0.05, 2.0, "and no longer between two of them"},
      {"birth_way_m", &p.birth_way_m, "m", 0.0, 2.0,
       "way after which something that moves is believed"},
      {"coast_s", &p.coast_s, "s", 0.1, 10.0, "a body that is not seen for longer is forgotten"},
      {"late_s", &p.late_s, "s", 0.0, 2.0, "frames later than this are not used"},
      {"same_place_m", &p.same_place_m, "m", 0.0, 1.0, "two bodies this near are one"},
      {"followed_radius_m", &p.followed_radius_m, "m", 0.05, 1.0, "of the person who is followed"},
  };
}

}  // namespace foretrack
