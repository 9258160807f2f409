// SPDX-License-Identifier: Apache-2.0
#include "core/fleet/fuse_target.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "core/common/white_acceleration.hpp"

namespace foretrack {
namespace {

constexpr double kAcceleration_m2_s3 = 2.0;  // density, of a walking person
constexpr int kWeights = 32;

using Vec6 = Eigen::Matrix<double, 6, 1>;

Vec6 mean_of(const FleetPerson& person) {
  Vec6 mean;
  mean << person.position_enu_m, person.velocity_enu_m_s;
  return mean;
}

}  // namespace

FleetPerson at_time(FleetPerson person, double from_s, double to_s) {
  const double dt_s = to_s - from_s;
  if (dt_s <= 0.0) return person;
  Mat6 step = Mat6::Identity();
  step.topRightCorner<3, 3>() = dt_s * Mat3::Identity();
  person.position_enu_m += dt_s * person.velocity_enu_m_s;
  person.covariance = step * person.covariance * step.transpose();
  add_white_acceleration<3>(person.covariance, Vec3(kAcceleration_m2_s3, kAcceleration_m2_s3, 0.0),
                            dt_s);  // nobody walks up
  return person;
}

double apart2(const FleetPerson& a, const FleetPerson& b) {
  const Mat2 covariance = a.covariance.topLeftCorner<2, 2>() + b.covariance.topLeftCorner<2, 2>();
  const Vec2 d = (a.position_enu_m - b.position_enu_m).head<2>();
  return d.dot(covariance.ldlt().solve(d));
}

FleetPerson intersect(const FleetPerson& a, const FleetPerson& b) {
  const Mat6 information_a = a.covariance.inverse(), information_b = b.covariance.inverse();
  double best = -1.0, weight = 1.0;
  for (int i = 0; i <= kWeights; ++i) {
    const double w = static_cast<double>(i) / kWeights;
    const double determinant = (w * information_a + (1.0 - w) * information_b).determinant();
    if (determinant <= best) continue;
    best = determinant;
    weight = w;
  }
  FleetPerson out = a;
  out.covariance = (weight * information_a + (1.0 - weight) * information_b).inverse();
  const Vec6 mean = out.covariance * (weight * information_a * mean_of(a) +
                                      (1.0 - weight) * information_b * mean_of(b));
  out.position_enu_m = mean.head<3>();
  out.velocity_enu_m_s = mean.tail<3>();
  out.in_sight = a.in_sight || b.in_sight;
  return out;
}

}  // namespace foretrack
