// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/motion_models.hpp"

namespace foretrack {
namespace {

constexpr double kStill_m_s = 1e-9;

// p += [s −c; c s] v and v = [cosine −sine; sine cosine] v.
struct TurnTerms {
  double s, c, sine, cosine;
};

TurnTerms turn_terms(double rate_rad_s, double dt_s) {
  const double angle = rate_rad_s * dt_s;
  const double sine = std::sin(angle), cosine = std::cos(angle);
  if (std::abs(angle) < 1e-4) {  // series: the quotients lose their digits here
    return {dt_s * (1.0 - angle * angle / 6.0), dt_s * angle / 2.0, sine, cosine};
  }
  return {sine / rate_rad_s, (1.0 - cosine) / rate_rad_s, sine, cosine};
}

PlanarState turned(double rate_rad_s, const PlanarState& x, double dt_s) {
  const TurnTerms t = turn_terms(rate_rad_s, dt_s);
  const double vx = x.velocity_m_s.x(), vy = x.velocity_m_s.y();
  return {x.position_m + Vec2(t.s * vx - t.c * vy, t.c * vx + t.s * vy),
          Vec2(t.cosine * vx - t.sine * vy, t.sine * vx + t.cosine * vy)};
}

PlanarState slowed(double rate_m_s2, const PlanarState& x, double dt_s) {
  const double speed = x.velocity_m_s.norm();
  if (speed < kStill_m_s) return {x.position_m, Vec2::Zero()};
  const double braking_s = std::min(dt_s, speed / rate_m_s2);
  const double path_m = braking_s * (speed - 0.5 * rate_m_s2 * braking_s);
  const double end_m_s = std::max(0.0, speed - rate_m_s2 * dt_s);
  return {x.position_m + x.velocity_m_s * (path_m / speed), x.velocity_m_s * (end_m_s / speed)};
}

MotionJacobian slowed_jacobian(double rate_m_s2, const PlanarState& x, double dt_s) {
  const double speed = x.velocity_m_s.norm();
  if (speed < kStill_m_s) return {Mat2::Zero(), Mat2::Zero()};
  const Vec2 along = x.velocity_m_s / speed;
  const Mat2 radial = along * along.transpose();
  const Mat2 across = Mat2::Identity() - radial;
  if (speed <= rate_m_s2 * dt_s) {  // at rest before the end
    return {(Mat2::Identity() + radial) * (speed / (2.0 * rate_m_s2)), Mat2::Zero()};
  }
  const double fall = rate_m_s2 * dt_s / speed;
  return {dt_s * (Mat2::Identity() - 0.5 * fall * across), Mat2::Identity() - fall * across};
}

}  // namespace

PlanarState advance(const MotionModel& model, const PlanarState& x, double dt_s) {
  switch (model.kind) {
    case MotionModel::Kind::kCoordinatedTurn:
      return turned(model.rate, x, dt_s);
    case MotionModel::Kind::kDeceleration:
      return slowed(model.rate, x, dt_s);
    case MotionModel::Kind::kConstantVelocity:
      break;
  }
  return {x.position_m + dt_s * x.velocity_m_s, x.velocity_m_s};
}

MotionJacobian jacobian(const MotionModel& model, const PlanarState& x, double dt_s) {
  switch (model.kind) {
    case MotionModel::Kind::kCoordinatedTurn: {
      const TurnTerms t = turn_terms(model.rate, dt_s);
      MotionJacobian j;
      j.position_by_velocity << t.s, -t.c, t.c, t.s;
      j.velocity_by_velocity << t.cosine, -t.sine, t.sine, t.cosine;
      return j;
    }
    case MotionModel::Kind::kDeceleration:
      return slowed_jacobian(model.rate, x, dt_s);
    case MotionModel::Kind::kConstantVelocity:
      break;
  }
  return {dt_s * Mat2::Identity(), Mat2::Identity()};
}

}  // namespace foretrack
