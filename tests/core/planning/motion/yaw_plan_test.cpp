// SPDX-License-Identifier: Apache-2.0
#include "core/planning/motion/yaw_plan.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

double acceleration(const AnglePlan& plan, std::size_t i) {
  return (plan.nodes[i + 1].rate_rad_s - plan.nodes[i].rate_rad_s) / plan.dt_s;
}

void expect_within(const AnglePlan& plan, const AngleLimits& limits) {
  for (std::size_t i = 0; i + 1 < plan.nodes.size(); ++i) {
    const AngleNode &a = plan.nodes[i], &b = plan.nodes[i + 1];
    EXPECT_LE(std::abs(acceleration(plan, i)), limits.acceleration_max_rad_s2 + 1e-9);
    EXPECT_LE(std::abs(b.rate_rad_s), limits.rate_max_rad_s + 1e-9);
    EXPECT_NEAR(b.angle_rad, a.angle_rad + 0.5 * plan.dt_s * (a.rate_rad_s + b.rate_rad_s), 1e-9);
  }
  EXPECT_EQ(plan.nodes.back().rate_rad_s, 0.0);
}

// The cost that is minimised, of any accelerations.
double cost_of(const AngleNode& start, const std::vector<double>& accelerations,
               const std::vector<double>& wanted, const AngleLimits& limits, double dt_s) {
  AngleNode node = start;
  double cost = 0.0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const double a = accelerations[i];
    node.angle_rad += node.rate_rad_s * dt_s + 0.5 * a * dt_s * dt_s;
    node.rate_rad_s += a * dt_s;
    cost += std::pow(node.angle_rad - wanted[i], 2) + limits.effort * a * a;
  }
  return cost + 0.3 * node.rate_rad_s * node.rate_rad_s;
}

class PlanAngle : public ::testing::Test {
 protected:
  void plan(const AngleNode& start, const std::vector<double>& wanted) {
    plan_angle(start, wanted, limits_, workspace_, plan_);
  }
  AngleLimits limits_;
  AnglePlanWorkspace workspace_;
  AnglePlan plan_;
};

TEST_F(PlanAngle, KeepsBothLimitsAndEndsAtRestWhateverIsWanted) {
  Random random(1);
  for (int run = 0; run < 300; ++run) {
    std::vector<double> wanted(random.integer(0, 45));
    for (double& w : wanted) w = random.uniform(-kPi, kPi);
    const AngleNode start{random.uniform(-9, 9), random.uniform(-2, 2)};
    plan(start, wanted);
    ASSERT_GT(plan_.nodes.size(), wanted.size());
    EXPECT_EQ(plan_.nodes.front().angle_rad, start.angle_rad);
    EXPECT_EQ(plan_.nodes.front().rate_rad_s, start.rate_rad_s);
    expect_within(plan_, limits_);
  }
}

TEST_F(PlanAngle, IsOptimalWhenNoLimitBinds) {
  std::vector<double> wanted(30);
  for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = 0.3 * std::sin(0.2 * (i + 1.0));
  const AngleNode start{0.05, 0.1};
  plan(start, wanted);
  std::vector<double> a(wanted.size());
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = acceleration(plan_, i);
  const double best = cost_of(start, a, wanted, limits_, plan_.dt_s);
  Random random(2);
  for (int run = 0; run < 200; ++run) {
    std::vector<double> other = a;
    other[random.integer(0, 29)] += random.uniform(-0.2, 0.2);
    EXPECT_GE(cost_of(start, other, wanted, limits_, plan_.dt_s), best - 1e-12);
  }
}

TEST_F(PlanAngle, FollowsATurningBearingClosely) {
  std::vector<double> wanted(40);
  for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = wrap_angle(2.5 + 0.1 * (i + 1.0));
  plan({2.5, 1.0}, wanted);
  for (std::size_t i = 0; i < 35; ++i)
    EXPECT_NEAR(wrap_angle(plan_.nodes[i + 1].angle_rad - wanted[i]), 0.0, 0.05);
}

TEST_F(PlanAngle, BeginsToTurnBeforeTheBearingJumps) {
  std::vector<double> wanted(40, 0.0);
  std::fill(wanted.begin() + 20, wanted.end(), 1.5);
  plan({0.0, 0.0}, wanted);
  EXPECT_GT(plan_.nodes[20].angle_rad, 0.2);
  EXPECT_NEAR(plan_.nodes[10].angle_rad, 0.0, 0.1);
  double worst_rad = 0.0;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    worst_rad = std::max(worst_rad, std::abs(plan_.nodes[i + 1].angle_rad - wanted[i]));
  EXPECT_LT(worst_rad, 1.1);  // of 1.5
}

TEST_F(PlanAngle, TakesTheShorterWayRound) {
  plan({3.0, 0.0}, std::vector<double>(40, -3.0));
  EXPECT_NEAR(plan_.nodes[40].angle_rad, 2.0 * kPi - 3.0, 0.02);
}

TEST_F(PlanAngle, BrakesARateBeyondTheLimit) {
  plan({0.0, 5.0}, std::vector<double>(20, 0.0));
  for (std::size_t i = 0; i + 1 < plan_.nodes.size(); ++i)
    EXPECT_LE(std::abs(acceleration(plan_, i)), limits_.acceleration_max_rad_s2 + 1e-9);
  EXPECT_NEAR(acceleration(plan_, 0), -limits_.acceleration_max_rad_s2, 1e-9);
}

}  // namespace
}  // namespace foretrack
