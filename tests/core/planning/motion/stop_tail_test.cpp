// SPDX-License-Identifier: Apache-2.0
#include "core/planning/motion/stop_tail.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

Vec3 random_direction(Random& random) {
  return Vec3(random.normal(), random.normal(), random.normal()).normalized();
}

TEST(StopTail, StartsAsGivenAndEndsAtRest) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const BoundaryState from{3.0 * random_direction(random), 2.0 * random_direction(random),
                             4.0 * random_direction(random)};
    const QuinticPiece piece = make_stop_tail(from, {}).piece;
    EXPECT_LT((piece.position(0.0) - from.position).norm(), 1e-12);
    EXPECT_LT((piece.velocity(0.0) - from.velocity).norm(), 1e-12);
    EXPECT_LT((piece.acceleration(0.0) - from.acceleration).norm(), 1e-12);
    EXPECT_LT(piece.velocity(piece.duration_s).norm(), 1e-9);
    EXPECT_LT(piece.acceleration(piece.duration_s).norm(), 1e-9);
  }
}

TEST(StopTail, KeepsTheLimitsFromEveryStateWithRoomForIt) {
  Random random(2);
  const FlightLimits limits;
  for (int i = 0; i < 300; ++i) {
    const BoundaryState from{Vec3::Zero(), random.uniform(0.0, 2.5) * random_direction(random),
                             random.uniform(0.0, 3.0) * random_direction(random)};
    const StopTail tail = make_stop_tail(from, limits);
    ASSERT_TRUE(tail.within_limits);
    for (int k = 0; k <= 200; ++k) {
      const double t = tail.piece.duration_s * k / 200.0;
      EXPECT_LE(tail.piece.velocity(t).norm(), limits.speed_max_m_s + 1e-9);
      EXPECT_LE(tail.piece.acceleration(t).norm(), limits.acceleration_max_m_s2 + 1e-9);
    }
  }
}

TEST(StopTail, StopsWithinTheExpectedDistance) {
  const StopTail tail = make_stop_tail({Vec3::Zero(), {3.0, 0.0, 0.0}, Vec3::Zero()}, {});
  const double distance_m = tail.piece.position(tail.piece.duration_s).x();
  EXPECT_GT(distance_m, 0.5 * 9.0 / 5.0);  // full braking all the way
  EXPECT_LT(distance_m, 1.9);
}

TEST(StopTail, SaysThatAStateBreaksTheLimits) {
  const StopTail tail = make_stop_tail({Vec3::Zero(), {9.0, 0.0, 0.0}, {0.0, 8.0, 0.0}}, {});
  EXPECT_FALSE(tail.within_limits);
  EXPECT_NEAR(tail.max_speed_m_s, 9.0, 0.5);
  EXPECT_LT(tail.piece.velocity(tail.piece.duration_s).norm(), 1e-9);
}

TEST(StopTail, RestStaysWhereItIs) {
  const StopTail tail = make_stop_tail({{1.0, 2.0, 3.0}, Vec3::Zero(), Vec3::Zero()}, {}, 0.5);
  EXPECT_TRUE(tail.within_limits);
  EXPECT_EQ(tail.piece.duration_s, 0.5);
  EXPECT_EQ(tail.piece.position(0.3), Vec3(1.0, 2.0, 3.0));
}

}  // namespace
}  // namespace foretrack
