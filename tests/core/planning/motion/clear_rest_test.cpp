// SPDX-License-Identifier: Apache-2.0
#include "core/planning/motion/clear_rest.hpp"

#include <gtest/gtest.h>

#include "tests/core/planning/planning_worlds.hpp"

namespace foretrack {
namespace {

// Eastward at 1 m/s for 6 s, past a pillar 0.5 m beside the way at x = 3.
class ClearRest : public ::testing::Test {
 protected:
  ClearRest() {
    World world = testing::empty_world();
    world.boxes.push_back({{2.7, 0.45, 0.0}, {3.3, 1.05, 4.0}});
    map_ = known_map(world, 0.15);
    QuinticPiece piece;
    piece.duration_s = 6.0;
    piece.coefficients.row(0) = Vec3(0.0, 0.0, 1.5);
    piece.coefficients.row(1) = Vec3(1.0, 0.0, 0.0);
    trajectory_.pieces = {piece};
  }
  bool clear(double t_s, double required_m) const {
    return rest_is_clear(map_, trajectory_, t_s, required_m);
  }
  GridMap map_;
  PlannedTrajectory trajectory_;
};

TEST_F(ClearRest, IsNotWhatPassesTooNear) {
  EXPECT_TRUE(clear(0.0, 0.3));
  EXPECT_FALSE(clear(0.0, 0.6));
}

TEST_F(ClearRest, CountsFromNowOn) {
  EXPECT_TRUE(clear(4.5, 0.6));
}

TEST_F(ClearRest, WhoIsTooNearMayLeaveButComeNoNearer) {
  EXPECT_TRUE(clear(3.0, 0.6));   // beside the pillar: it leaves
  EXPECT_FALSE(clear(2.3, 0.6));  // near, and comes nearer
}

}  // namespace
}  // namespace foretrack
