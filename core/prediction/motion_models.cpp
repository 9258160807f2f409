// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/motion_models.hpp"

#include <algorithm>

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

// The velocity changes straight towards the goal, and is then kept.
struct Change {
  Vec2 along;       // unit, or zero where there is nothing to change
  double amount;    // of velocity
  double length_s;  // that it takes
};
Change change_to(const MotionModel& model, const Vec2& velocity_m_s) {
  const Vec2 change = model.goal_m_s - velocity_m_s;
  const double amount = change.norm();
  if (amount < kStill_m_s) return {Vec2::Zero(), 0.0, 0.0};
  return {change / amount, amount, amount / model.rate};
}

PlanarState changed(const MotionModel& model, const PlanarState& x, double dt_s) {
  const Change c = change_to(model, x.velocity_m_s);
  const double t_s = std::min(dt_s, c.length_s);
  const Vec2 there = x.position_m + t_s * (x.velocity_m_s + 0.5 * t_s * model.rate * c.along);
  if (dt_s < c.length_s) return {there, x.velocity_m_s + t_s * model.rate * c.along};
  return {there + (dt_s - t_s) * model.goal_m_s, model.goal_m_s};
}

MotionJacobian changed_jacobian(const MotionModel& model, const PlanarState& x, double dt_s) {
  const Change c = change_to(model, x.velocity_m_s);
  const Mat2 radial = c.along * c.along.transpose();
  if (dt_s >= c.length_s)  // at the goal before the end
    return {0.5 * c.length_s * (Mat2::Identity() + radial), Mat2::Zero()};
  const double share = dt_s / c.length_s;
  const Mat2 across = Mat2::Identity() - radial;
  return {dt_s * (Mat2::Identity() - 0.5 * share * across), Mat2::Identity() - share * across};
}

}  // namespace

PlanarState advance(const MotionModel& model, const PlanarState& x, double dt_s) {
  switch (model.kind) {
    case MotionModel::Kind::kCoordinatedTurn:
      return turned(model.rate, x, dt_s);
    case MotionModel::Kind::kDeceleration:
    case MotionModel::Kind::kReversal:
      return changed(model, x, dt_s);
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
    case MotionModel::Kind::kReversal:
      return changed_jacobian(model, x, dt_s);
    case MotionModel::Kind::kConstantVelocity:
      break;
  }
  return {dt_s * Mat2::Identity(), Mat2::Identity()};
}

}  // namespace foretrack
