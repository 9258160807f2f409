// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/generate_world.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

TEST(GenerateWorld, SameSeedGivesTheSameWorldAndAnotherSeedAnother) {
  for (int k = 1; k < static_cast<int>(kWorldKindNames.size()); ++k) {
    const auto kind = static_cast<WorldKind>(k);
    const World a = generate_world({kind, 60, 1}), b = generate_world({kind, 60, 1});
    EXPECT_GT(a.boxes.size() + a.cylinders.size(), 2u) << kWorldKindNames[k];
    ASSERT_EQ(a.boxes.size(), b.boxes.size());
    for (std::size_t i = 0; i < a.boxes.size(); ++i) EXPECT_EQ(a.boxes[i].max_m, b.boxes[i].max_m);
    const World c = generate_world({kind, 60, 2});
    const bool differs =
        a.boxes.size() != c.boxes.size() ||
        (!a.boxes.empty() && a.boxes[0].max_m != c.boxes[0].max_m) ||
        (!a.cylinders.empty() && a.cylinders[0].center_m != c.cylinders[0].center_m);
    EXPECT_TRUE(differs) << kWorldKindNames[k];
  }
}

TEST(GenerateWorld, KeepsTheRouteFree) {
  const std::vector<Vec2> route = {{0, 0}, {6, 0}, {6, 8}};
  const World world =
      generate_world({WorldKind::kBoxes, 120, 4}, {-20, -20, 0}, {20, 20, 5}, route);
  EXPECT_GT(world.boxes.size(), 80u);
  EXPECT_GE(ground_clearance_m(world, route[0], route[1]), 1.0);
  EXPECT_GE(ground_clearance_m(world, route[1], route[2]), 1.0);
}

TEST(GenerateWorld, ScatteredShapesLeaveRoomToPass) {
  const World world = generate_world({WorldKind::kCylinders, 80, 9});
  for (std::size_t i = 0; i < world.cylinders.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto &a = world.cylinders[i], &b = world.cylinders[j];
      EXPECT_GE((a.center_m - b.center_m).norm() - a.radius_m - b.radius_m, 1.19);
    }
}

TEST(GenerateWorld, EveryShapeStandsOnTheGroundAndScatteredOnesAreInsideTheBounds) {
  const Vec3 low(-15.0, -12.0, 0.5), high(15.0, 12.0, 6.0);
  for (int k = 1; k < static_cast<int>(kWorldKindNames.size()); ++k) {
    const World world = generate_world({static_cast<WorldKind>(k), 60, 3}, low, high);
    for (const Box& b : world.boxes) {
      EXPECT_TRUE((b.min_m.array() < b.max_m.array()).all()) << kWorldKindNames[k];
      EXPECT_EQ(b.min_m.z(), low.z()) << kWorldKindNames[k];
      const bool scattered = static_cast<WorldKind>(k) <= WorldKind::kBlocks ||
                             static_cast<WorldKind>(k) == WorldKind::kHedges;
      EXPECT_TRUE(!scattered || (world.contains(b.min_m) && world.contains(b.max_m)));
    }
    for (const Cylinder& c : world.cylinders) {
      EXPECT_EQ(c.base_m, low.z());
      EXPECT_TRUE(world.contains({c.center_m.x() - c.radius_m, c.center_m.y(), 1.0}));
      EXPECT_TRUE(world.contains({c.center_m.x() + c.radius_m, c.center_m.y(), 1.0}));
    }
  }
}

TEST(GenerateWorld, TheStreetsOfATIntersectionAreFreeAndTheRestIsNot) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const World world = generate_world({WorldKind::kTIntersection, 0, seed});
    EXPECT_GE(ground_clearance_m(world, {-13, 0}, {0, 0}), 1.3) << "the stem";
    EXPECT_GE(ground_clearance_m(world, {0, -13}, {0, 13}), 1.3) << "the street across";
    EXPECT_EQ(ground_clearance_m(world, {-6, 6}), 0.0);
    EXPECT_EQ(ground_clearance_m(world, {-6, -6}), 0.0);
    EXPECT_FALSE(line_of_sight(world, {0, 0, 1.5}, {6, 0, 1.5})) << "a wall opposite the stem";
    EXPECT_FALSE(line_of_sight(world, {-6, 0, 1.5}, {0, 6, 1.5})) << "around the corner";
  }
}

TEST(GenerateWorld, EveryRoomHasADoorInEachWall) {
  const World world = generate_world({WorldKind::kDoorways, 0, 7});
  // Along each inner wall, piece by piece of a room's length, there is a gap of 1.6 m.
  for (const int axis : {0, 1})
    for (double wall = -14.0; wall < 19.0; wall += 6.0)
      for (double room = -20.0; room + 6.0 <= 20.0; room += 6.0) {
        double widest_m = 0.0, from_m = room;
        for (double along = room; along < room + 6.0; along += 0.02) {
          Vec2 p;
          p[axis] = wall;
          p[1 - axis] = along;
          if (ground_clearance_m(world, p) <= 0.0) from_m = along;
          widest_m = std::max(widest_m, along - from_m);
        }
        EXPECT_GT(widest_m, 1.4) << axis << ' ' << wall << ' ' << room;
        EXPECT_LT(widest_m, 2.2) << axis << ' ' << wall << ' ' << room;
      }
}

TEST(GenerateWorld, TheHallwayIsFreeAndItsWallsHaveOpenings) {
  const World world = generate_world({WorldKind::kCorridor, 0, 2});
  EXPECT_NEAR(ground_clearance_m(world, {-20, 0}, {20, 0}), 1.5, 1e-9);
  for (const double side_m : {-1.65, 1.65}) {
    int open = 0;
    for (double x = -19.0; x < 19.0; x += 0.5) open += ground_clearance_m(world, {x, side_m}) > 0.0;
    EXPECT_GT(open, 5);
    EXPECT_LT(open, 50);
  }
}

}  // namespace
}  // namespace foretrack
