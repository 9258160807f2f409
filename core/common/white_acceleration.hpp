// SPDX-License-Identifier: Apache-2.0
// The process noise of everything here that is followed with position and velocity.
#pragma once

#include "core/common/geometry.hpp"

namespace foretrack {

/// Adds to the covariance of (position, velocity) what white acceleration brings in dt_s. The
/// density is that of each axis, in m²/s³. Source: Bar-Shalom, Li and Kirubarajan, Estimation with
/// Applications to Tracking and Navigation, 2001, §6.2.2.
template <int kAxes>
void add_white_acceleration(Eigen::Matrix<double, 2 * kAxes, 2 * kAxes>& covariance,
                            const Eigen::Matrix<double, kAxes, 1>& density_m2_s3, double dt_s) {
  for (int a = 0; a < kAxes; ++a) {
    const double q = density_m2_s3[a];
    covariance(a, a) += q * dt_s * dt_s * dt_s / 3.0;
    covariance(a, a + kAxes) += q * dt_s * dt_s / 2.0;
    covariance(a + kAxes, a) += q * dt_s * dt_s / 2.0;
    covariance(a + kAxes, a + kAxes) += q * dt_s;
  }
}

}  // namespace foretrack
