// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/short_term_motion.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "tests/core/prediction/worlds.hpp"

namespace foretrack {
namespace {

using testing::walker;

constexpr double kMotionStep_s = 0.03, kLead_s = 0.3;
// Of a second-order filter at 8 rad/s, about as slow as the tracker's.
constexpr double kMotionPositionGain = 0.34, kMotionVelocityGain_hz = 1.9;

// A walk of so many seconds at velocity_m_s(t), as a filter sees it that lags; the chest is kLead_s
// early. At its end: what was believed, and what is true.
struct Watched {
  MotionHistory history;
  TargetState target;
  PlanarState truth;
};

Watched watch(const std::function<Vec2(double)>& velocity_m_s, double duration_s,
              bool chest_seen = true) {
  Watched w;
  PlanarState filtered{Vec2::Zero(), velocity_m_s(0.0)};
  double body_yaw_rad = 0.0;
  for (double t = kMotionStep_s; t < duration_s; t += kMotionStep_s) {
    w.truth.velocity_m_s = velocity_m_s(t);
    w.truth.position_m += kMotionStep_s * w.truth.velocity_m_s;
    filtered = advance(MotionModel::constant_velocity(), filtered, kMotionStep_s);
    const Vec2 innovation = w.truth.position_m - filtered.position_m;
    filtered.position_m += kMotionPositionGain * innovation;
    filtered.velocity_m_s += kMotionVelocityGain_hz * innovation;
    w.target = walker(filtered.position_m, filtered.velocity_m_s, t);
    const Vec2 soon_m_s = velocity_m_s(t + kLead_s);
    if (soon_m_s.norm() > 0.1) body_yaw_rad = yaw_of(soon_m_s);
    w.target.body_yaw_rad = chest_seen ? body_yaw_rad : std::numeric_limits<double>::quiet_NaN();
    remember(w.history, {t, filtered, w.target.body_yaw_rad});
  }
  return w;
}

Vec2 turns_left_after_1s(double t) {
  return 1.5 * direction_of(2.0 * std::clamp(t - 1.0, 0.0, 0.7));
}
Vec2 stops_after_1s(double t) {
  return {std::clamp(2.0 - 3.0 * (t - 1.0), 0.0, 2.0), 0.0};
}

TEST(ShortTermMotion, HardlyChangesASteadyWalk) {
  for (const bool chest_seen : {true, false}) {
    const Watched w = watch([](double) { return Vec2(1.2, -0.7); }, 2.0, chest_seen);
    const ShortTermMotion motion = short_term_motion(w.history, w.target);
    EXPECT_LT((motion.now.position_m - w.truth.position_m).norm(), 0.05);
    EXPECT_LT((motion.now.velocity_m_s - w.truth.velocity_m_s).norm(), 0.1);
    EXPECT_LT((motion.soon.velocity_m_s - w.truth.velocity_m_s).norm(), 0.1);
    const Vec2 way_m = ShortTermMotion::kSoon_s * w.truth.velocity_m_s;
    EXPECT_LT((motion.soon.position_m - w.truth.position_m - way_m).norm(), 0.05);
  }
}

TEST(ShortTermMotion, LeavesWhoStandsWhereItIs) {
  const Watched w = watch([](double) { return Vec2(0.0, 0.0); }, 2.0);
  const ShortTermMotion motion = short_term_motion(w.history, w.target);
  EXPECT_LT((motion.soon.position_m - w.truth.position_m).norm(), 0.05);
  EXPECT_LT(motion.soon.velocity_m_s.norm(), 0.15);  // it might set off
}

TEST(ShortTermMotion, KnowsTheCourseInATurnThatTheFilterFollowsLate) {
  for (double t = 1.15; t < 1.5; t += 0.05) {
    const Watched w = watch(turns_left_after_1s, t);
    const ShortTermMotion motion = short_term_motion(w.history, w.target);
    const Vec2 late_m_s = w.target.velocity_enu_m_s.head<2>() - w.truth.velocity_m_s;
    EXPECT_LT((motion.now.velocity_m_s - w.truth.velocity_m_s).norm(), 0.85 * late_m_s.norm());
    const Vec2 soon_m_s = turns_left_after_1s(t + ShortTermMotion::kSoon_s);
    const Vec2 later_m_s = w.target.velocity_enu_m_s.head<2>() - soon_m_s;
    EXPECT_LT((motion.soon.velocity_m_s - soon_m_s).norm(), 0.4 * later_m_s.norm());
  }
}

TEST(ShortTermMotion, KnowsWithoutAChestThatASpeedFallsOn) {
  const Watched w = watch(stops_after_1s, 1.4, false);
  const ShortTermMotion motion = short_term_motion(w.history, w.target);
  EXPECT_LT(motion.soon.velocity_m_s.x(), w.target.velocity_enu_m_s.x() - 0.1);
  EXPECT_GT(motion.soon.velocity_m_s.x(), stops_after_1s(1.4 + ShortTermMotion::kSoon_s).x());
}

TEST(ShortTermMotion, KeepsToWhatIsPossibleWhateverTheHistory) {
  Watched w = watch(turns_left_after_1s, 1.4);
  w.target.velocity_enu_m_s.head<2>() = Vec2(-60.0, 40.0);  // as nobody moves
  const ShortTermMotion motion = short_term_motion(w.history, w.target);
  const Vec2 believed_m_s = w.target.velocity_enu_m_s.head<2>();
  EXPECT_LE((motion.now.velocity_m_s - believed_m_s).norm(), 2.0 + 1e-9);
  EXPECT_LE((motion.now.position_m - w.target.position_enu_m.head<2>()).norm(), 0.5 + 1e-9);
}

TEST(ShortTermMotion, TurnsAndMirrorsWithTheWalk) {
  const Vec2 mirrored(1.0, -1.0);
  const Eigen::Rotation2Dd turn(2.0);
  const auto motion_of = [](const std::function<Vec2(double)>& velocity) {
    const Watched w = watch(velocity, 1.3);
    return short_term_motion(w.history, w.target);
  };
  const ShortTermMotion left = motion_of(turns_left_after_1s);
  const ShortTermMotion right =
      motion_of([&](double t) { return turns_left_after_1s(t).cwiseProduct(mirrored).eval(); });
  const ShortTermMotion turned =
      motion_of([&](double t) { return Vec2(turn * turns_left_after_1s(t)); });
  EXPECT_LT((left.soon.velocity_m_s - right.soon.velocity_m_s.cwiseProduct(mirrored)).norm(), 1e-9);
  EXPECT_LT((left.soon.position_m - right.soon.position_m.cwiseProduct(mirrored)).norm(), 1e-9);
  EXPECT_LT((turn * left.now.velocity_m_s - turned.now.velocity_m_s).norm(), 1e-9);
  EXPECT_LT((turn * left.now.position_m - turned.now.position_m).norm(), 1e-9);
}

}  // namespace
}  // namespace foretrack
