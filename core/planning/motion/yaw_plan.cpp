// SPDX-License-Identifier: Apache-2.0
#include "core/planning/motion/yaw_plan.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack {
namespace {

constexpr int kPasses = 4;
constexpr double kOutOfViewWeight = 8.0;
constexpr double kEndRateWeight = 0.3;  // of the squared rate at the last node
constexpr int kBrakeNodesMax = 40;

using Stage = AnglePlanWorkspace::Stage;

// The quadratic cost to go, ½ xᵀ P x + pᵀ x with x = (angle, rate).
struct CostToGo {
  double aa = 0.0, ar = 0.0, rr = 0.0;  // P
  double a = 0.0, r = 0.0;              // p
};

// One step of the Riccati recursion: ψ⁺ = ψ + ω dt + ½ α dt², ω⁺ = ω + α dt.
CostToGo step_back(CostToGo c, double dt, double effort, Stage& stage) {
  c.aa += stage.weight;  // the error at the node this stage leads to
  c.a -= stage.weight * stage.wanted_rad;
  const double b0 = 0.5 * dt * dt, b1 = dt;
  const double cb0 = c.aa * b0 + c.ar * b1, cb1 = c.ar * b0 + c.rr * b1;  // P B
  const double quu = effort + b0 * cb0 + b1 * cb1;
  const double qux0 = cb0, qux1 = cb0 * dt + cb1;  // Bᵀ P A
  const double qu = b0 * c.a + b1 * c.r;
  stage.gain_angle = qux0 / quu;
  stage.gain_rate = qux1 / quu;
  stage.feedforward = -qu / quu;
  // Aᵀ P A and Aᵀ p, then what the acceleration does to them.
  CostToGo v;
  v.aa = c.aa;
  v.ar = c.aa * dt + c.ar;
  v.rr = c.aa * dt * dt + 2.0 * c.ar * dt + c.rr;
  v.a = c.a;
  v.r = c.a * dt + c.r;
  if (stage.clamped) {
    v.a += qux0 * stage.acceleration;
    v.r += qux1 * stage.acceleration;
    return v;
  }
  v.aa -= qux0 * stage.gain_angle;
  v.ar -= qux0 * stage.gain_rate;
  v.rr -= qux1 * stage.gain_rate;
  v.a += qux0 * stage.feedforward;
  v.r += qux1 * stage.feedforward;
  return v;
}

// The acceleration nearest to the wanted one that keeps both limits until the next node.
double limited(double acceleration, double rate, double dt, const AngleLimits& limits) {
  const double most = limits.acceleration_max_rad_s2;
  const double high = std::clamp((limits.rate_max_rad_s - rate) / dt, -most, most);
  const double low = std::clamp((-limits.rate_max_rad_s - rate) / dt, -most, most);
  return std::clamp(acceleration, low, high);
}

AngleNode advance(const AngleNode& node, double acceleration, double dt) {
  return {node.angle_rad + node.rate_rad_s * dt + 0.5 * acceleration * dt * dt,
          node.rate_rad_s + acceleration * dt};
}

void roll_out(const AngleNode& start, const AngleLimits& limits, std::vector<Stage>& stages,
              AnglePlan& plan) {
  plan.nodes.assign(1, start);
  for (Stage& s : stages) {
    const AngleNode node = plan.nodes.back();
    const double free =
        s.feedforward - s.gain_angle * node.angle_rad - s.gain_rate * node.rate_rad_s;
    s.acceleration = limited(free, node.rate_rad_s, plan.dt_s, limits);
    s.clamped = s.acceleration != free;
    const AngleNode next = advance(node, s.acceleration, plan.dt_s);
    const bool out = std::abs(next.angle_rad - s.wanted_rad) > limits.tolerance_rad;
    s.weight = out ? kOutOfViewWeight : 1.0;
    plan.nodes.push_back(next);
  }
}

void brake(const AngleLimits& limits, AnglePlan& plan) {
  for (int i = 0; i < kBrakeNodesMax && plan.nodes.back().rate_rad_s != 0.0; ++i) {
    const AngleNode node = plan.nodes.back();
    const double wanted = -node.rate_rad_s / plan.dt_s;
    const double most = limits.acceleration_max_rad_s2;
    AngleNode next = advance(node, std::clamp(wanted, -most, most), plan.dt_s);
    if (std::abs(wanted) <= most) next.rate_rad_s = 0.0;
    plan.nodes.push_back(next);
  }
}

}  // namespace

void plan_angle(const AngleNode& start, const std::vector<double>& wanted_rad,
                const AngleLimits& limits, AnglePlanWorkspace& workspace, AnglePlan& plan) {
  auto& stages = workspace.stages;
  stages.clear();
  double before_rad = start.angle_rad;
  for (const double wanted : wanted_rad) {
    before_rad += wrap_angle(wanted - before_rad);
    stages.push_back({before_rad, 1.0, 0.0, 0.0, 0.0, false, 0.0});
  }
  for (int pass = 0; pass < kPasses; ++pass) {
    CostToGo cost;
    cost.rr = kEndRateWeight;
    for (auto s = stages.rbegin(); s != stages.rend(); ++s)
      cost = step_back(cost, plan.dt_s, limits.effort, *s);
    roll_out(start, limits, stages, plan);
  }
  brake(limits, plan);
}

}  // namespace foretrack
