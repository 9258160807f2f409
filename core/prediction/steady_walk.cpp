#include "core/prediction/steady_walk.hpp"

#include <algorithm>

namespace foretrack {
namespace {

constexpr double kForgottenAfter_s = 1.0;

void start(SteadyWalk& walk, const PlanarState& measured, double stamp_s) {
  walk = {.started = true, .stamp_s = stamp_s, .manoeuvre = 1.0, .line = measured};
}

// Gains of a line through n equally spaced points, the newest counted as far as the memory goes.
void correct(SteadyWalk& walk, const PlanarState& measured, double dt_s) {
  const double n = walk.memory_s / dt_s + 2.0;
  const Vec2 innovation = measured.position_m - walk.line.position_m;
  walk.line.position_m += 2.0 * (2.0 * n - 1.0) / (n * (n + 1.0)) * innovation;
  walk.line.velocity_m_s += 6.0 / (n * (n + 1.0) * dt_s) * innovation;
}

}  // namespace

PlanarState SteadyWalk::state(const PlanarState& measured) const {
  const auto between = [&](const Vec2& steady, const Vec2& now) -> Vec2 {
    return steady + manoeuvre * (now - steady);
  };
  return {between(line.position_m, measured.position_m),
          between(line.velocity_m_s, measured.velocity_m_s)};
}

void follow(SteadyWalk& walk, const PlanarState& measured, double stamp_s, double body_swing_rad,
            const PredictionParams& params) {
  const double dt_s = stamp_s - walk.stamp_s;
  if (!walk.started || dt_s < 0.0 || dt_s > kForgottenAfter_s)
    return start(walk, measured, stamp_s);
  if (dt_s < 1e-6) return;
  walk.stamp_s = stamp_s;
  walk.memory_s += dt_s;
  walk.line = advance(MotionModel::constant_velocity(), walk.line, dt_s);
  correct(walk, measured, dt_s);
  const double change_m_s = (measured.velocity_m_s - walk.line.velocity_m_s).norm();
  const double swing_rad = std::max(0.0, std::abs(body_swing_rad) - params.steady_swing_rad);
  walk.manoeuvre =
      std::min(1.0, change_m_s / params.manoeuvre_m_s + swing_rad / params.manoeuvre_swing_rad);
  if (walk.manoeuvre >= 1.0) return start(walk, measured, stamp_s);
  walk.memory_s = std::min(walk.memory_s, params.steady_memory_s * (1.0 - walk.manoeuvre));
}

}  // namespace foretrack
