// SPDX-License-Identifier: Apache-2.0
#include "core/planning/see/look_ahead.hpp"

#include <gtest/gtest.h>

#include "tests/core/planning/see/expected_walks.hpp"

namespace foretrack {
namespace {

using testing::add_walk;
using testing::empty_world;
using testing::FlatContext;
using testing::kExpectedSteps;

constexpr double kLookHeight_m = 1.5;
const Vec3 kBehind(-2.0, 0.0, kLookHeight_m), kTarget(0.0, 0.0, 1.0), kAlong(1.5, 0.0, 0.0);

class LooksAhead : public ::testing::Test {
 protected:
  void look(const FlatContext& c, const Vec3& start = kBehind, const Vec3& velocity = Vec3::Zero(),
            const IntentionAssessment* assessment = nullptr) {
    StageClock clock;
    look_ahead(c.context(), start, velocity, expected_, assessment, clock, ahead_);
  }
  ExpectedTarget expected_;
  LookAhead ahead_;
};

TEST_F(LooksAhead, InTheOpenEachPlaceIsSeenFromItsWaypointOnTheRing) {
  const FlatContext c(known_map(empty_world(), 0.15), kLookHeight_m);
  add_walk(expected_, 1.0, kTarget, kAlong);
  look(c);
  EXPECT_TRUE(ahead_.target_seen);
  EXPECT_TRUE(ahead_.path_found);
  ASSERT_EQ(ahead_.views[0].size(), std::size_t{kExpectedSteps});
  ASSERT_EQ(ahead_.way.arrival.size(), std::size_t{kExpectedSteps});
  int before = 0;
  for (int k = 0; k < kExpectedSteps; ++k) {
    const int at = ahead_.way.arrival[static_cast<std::size_t>(k)];
    EXPECT_GE(at, before);
    before = at;
    const Vec3& z = expected_.paths[0].positions_enu_m[static_cast<std::size_t>(k)];
    const Vec3& waypoint = ahead_.way.points[static_cast<std::size_t>(at)];
    EXPECT_NEAR(distance_xy(waypoint, z), 2.0, c.params.place.ring_tolerance_m + 0.01) << k;
    const View& view = ahead_.views[0][static_cast<std::size_t>(k)];
    ASSERT_TRUE(view.seen) << k;
    EXPECT_TRUE(view.visible.contains(yaw_of(Vec2((waypoint - z).head<2>())))) << k;
  }
}

TEST_F(LooksAhead, ALikelyTurnToTheLeftTakesRoomFromTheRegionsAndNotWithoutMargins) {
  FlatContext c(known_map(empty_world(), 0.15), kLookHeight_m);
  add_walk(expected_, 1.0, kTarget, kAlong);
  look(c);
  const ViewSector plain = ahead_.views[0][3].shrunk;
  IntentionAssessment assessment;
  assessment.margins.left = 1.0;
  look(c, kBehind, Vec3::Zero(), &assessment);
  const ViewSector wary = ahead_.views[0][3].shrunk;
  EXPECT_LT(wary.half_angle_rad, plain.half_angle_rad - 0.1);
  EXPECT_GT(std::abs(wrap_angle(wary.bisector_rad - plain.bisector_rad)), 0.05) << "one side only";
  c.params.horizon.intention_margins = false;
  look(c, kBehind, Vec3::Zero(), &assessment);
  EXPECT_NEAR(ahead_.views[0][3].shrunk.half_angle_rad, plain.half_angle_rad, 1e-9);
}

TEST_F(LooksAhead, TheWayBeginsAlongThePresentMotionUnlessThatIsBlocked) {
  World world = empty_world();
  add_walk(expected_, 1.0, kTarget, kAlong);
  const Vec3 sideways(0.0, 2.0, 0.0);
  const FlatContext open(known_map(world, 0.15), kLookHeight_m);
  look(open, kBehind, sideways);
  ASSERT_GE(ahead_.way.points.size(), 2u);
  EXPECT_LT((ahead_.way.points[1] - Vec3(-2.0, 0.4, kLookHeight_m)).norm(), 1e-9);
  world.boxes.push_back({{-3.0, 0.6, 0.0}, {-1.0, 1.0, 4.0}});
  const FlatContext blocked(known_map(world, 0.15), kLookHeight_m);
  look(blocked, kBehind, sideways);
  for (const Vec3& p : ahead_.way.points)
    EXPECT_GE(blocked.map.unfree_distance_m(p), blocked.params.path_clearance_m() - 1e-9);
}

TEST_F(LooksAhead, ToAnotherLevelItRisesBefore) {
  const FlatContext c(known_map(empty_world(), 0.15), kLookHeight_m);
  add_walk(expected_, 1.0, kTarget, kAlong);
  look(c, {-2.0, 0.0, 0.8}, {2.0, 0.0, 0.0});
  ASSERT_GE(ahead_.way.points.size(), 2u);
  EXPECT_LT((ahead_.way.points[1] - kBehind).norm(), 1e-9);
}

TEST_F(LooksAhead, WhoIsWalledInIsNotSeenAndTheWayGoesNear) {
  World world = empty_world();
  for (const double side : {-1.0, 1.0}) {
    world.boxes.push_back({{3.0 + side - 0.1, -1.1, 0.0}, {3.0 + side + 0.1, 1.1, 4.0}});
    world.boxes.push_back({{1.9, side - 0.1, 0.0}, {4.1, side + 0.1, 4.0}});
  }
  const FlatContext c(known_map(world, 0.15), kLookHeight_m);
  add_walk(expected_, 1.0, {3.0, 0.0, 1.0}, Vec3::Zero());
  look(c, {-4.0, 0.0, kLookHeight_m});
  EXPECT_FALSE(ahead_.target_seen);
  EXPECT_TRUE(ahead_.path_found);
  for (const View& view : ahead_.views[0]) EXPECT_FALSE(view.seen);
}

TEST_F(LooksAhead, PlacesThatRunTogetherWithALikelierPathHaveNoViewOfTheirOwn) {
  const FlatContext c(known_map(empty_world(), 0.15), kLookHeight_m);
  add_walk(expected_, 0.7, kTarget, kAlong);
  add_walk(expected_, 0.3, kTarget, kAlong, 1.0, {0.0, 1.5, 0.0});
  look(c);
  ASSERT_EQ(ahead_.views[1].size(), std::size_t{kExpectedSteps});
  EXPECT_FALSE(ahead_.views[1][0].seen);
  EXPECT_FALSE(ahead_.views[1][4].seen) << "they part after a second";
  EXPECT_TRUE(ahead_.views[1].back().seen);
}

TEST_F(LooksAhead, APathThatTheWaypointDoesNotSeeIsLookedAtFromTheNearestSideThatDoes) {
  World world = empty_world();
  world.boxes.push_back({{1.2, 0.8, 0.0}, {2.0, 5.0, 4.0}});  // right beside whoever turns left
  const FlatContext c(known_map(world, 0.15), kLookHeight_m);
  add_walk(expected_, 0.7, kTarget, kAlong);
  add_walk(expected_, 0.3, {2.8, 0.0, 1.0}, {0.0, 1.2, 0.0});
  look(c, {0.8, 0.0, kLookHeight_m});
  const Vec3& z = expected_.paths[1].positions_enu_m[10];
  const Vec3& waypoint = ahead_.way.points[static_cast<std::size_t>(ahead_.way.arrival[10])];
  const View& view = ahead_.views[1][10];
  ASSERT_TRUE(view.seen);
  const Vec2 middle = z.head<2>() + 2.0 * direction_of(view.visible.bisector_rad);
  EXPECT_TRUE(line_of_sight(c.map, z, {middle.x(), middle.y(), kLookHeight_m}));
  EXPECT_GT(view.visible.half_angle_rad, 0.2);
  EXPECT_GT(distance_xy(waypoint, z), 0.5);
}

}  // namespace
}  // namespace foretrack
