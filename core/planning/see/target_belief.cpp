// SPDX-License-Identifier: Apache-2.0
#include "core/planning/see/target_belief.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack {
namespace {

constexpr double kExtrapolation_s = 0.4;  // of a path that ends before the planning horizon

void constant_velocity(const TargetState& target, const HorizonParams& params,
                       PredictedPath& path) {
  path.intention = {};
  path.probability = 1.0;
  path.states.clear();
  const int count = static_cast<int>(std::lround(params.horizon_s / params.step_s));
  Vec3 velocity = target.velocity_enu_m_s;
  velocity.z() = 0.0;
  for (int k = 1; k <= count; ++k) {
    PredictedState state;
    state.time_s = k * params.step_s;
    state.position_enu_m = target.position_enu_m + state.time_s * velocity;
    state.velocity_enu_m_s = velocity;
    path.states.push_back(state);
  }
}

// On the path at a time after its stamp. Some time after its end the target stands.
PathPoint sample(const PredictedPath& path, double time_s) {
  const double last_s = path.states.back().time_s + kExtrapolation_s;
  PathPoint point = path.at(std::clamp(time_s, 0.0, last_s));
  if (time_s > last_s) point.velocity_enu_m_s.setZero();
  return point;
}

}  // namespace

Vec3 position_on(const PredictedPath& path, double time_s) {
  return sample(path, time_s).position_enu_m;
}

Vec3 ExpectedPath::position(double t_s) const {
  return position_on(*believed, start_s + t_s);
}

int ExpectedTarget::owner(int i, std::size_t k, double near_m) const {
  const Vec3& place = paths[i].positions_enu_m[k];
  for (int j = 0; j < i; ++j)
    if ((place - paths[j].positions_enu_m[k]).squaredNorm() < near_m * near_m &&
        owner(j, k, near_m) == j)
      return j;
  return i;
}

void update_belief(TargetBelief& belief, const TargetState& target, const Prediction* prediction,
                   const HorizonParams& params) {
  belief.count = 0;
  const bool usable =
      prediction != nullptr && (prediction->status == PredictionStatus::kOk ||
                                prediction->status == PredictionStatus::kSearchExhausted);
  if (usable) {
    belief.stamp_s = prediction->stamp_s;
    for (const PredictedPath& path : prediction->paths) {
      if (belief.count == kMaxIntentions) break;
      if (!path.states.empty()) belief.paths[belief.count++] = path;
    }
  }
  if (belief.count > 0) return;
  belief.stamp_s = target.stamp_s;
  belief.count = 1;
  constant_velocity(target, params, belief.paths[0]);
}

void align(const TargetBelief& belief, double start_s, const HorizonParams& params,
           ExpectedTarget& expected) {
  const int steps = static_cast<int>(std::lround(params.horizon_s / params.step_s));
  expected.count = 0;
  double sum = 0.0;
  for (int i = 0; i < belief.count; ++i) {
    const PredictedPath& path = belief.paths[i];
    const bool wanted = params.hedging && path.probability >= params.path_probability_min;
    if (i > 0 && !wanted) continue;
    ExpectedPath& out = expected.paths[expected.count++];
    out.believed = &path;
    out.start_s = start_s - belief.stamp_s;
    out.probability = std::max(path.probability, 1e-3);
    sum += out.probability;
    out.positions_enu_m.resize(steps);
    out.velocities_enu_m_s.resize(steps);
    for (int k = 0; k < steps; ++k) {
      const PathPoint point = sample(path, out.start_s + (k + 1) * params.step_s);
      out.positions_enu_m[k] = point.position_enu_m;
      out.velocities_enu_m_s[k] = point.velocity_enu_m_s;
    }
  }
  for (int i = 0; i < expected.count; ++i) expected.paths[i].probability /= sum;
}

}  // namespace foretrack
