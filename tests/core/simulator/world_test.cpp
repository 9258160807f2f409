// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/world.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/common/random.hpp"
#include "core/simulator/generate_world.hpp"

namespace foretrack {
namespace {

Vec3 random_point(Random& random, double reach) {
  return {random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(0.0, 5.0)};
}
Vec3 random_direction(Random& random) {
  return Vec3(random.normal(), random.normal(), random.normal()).normalized();
}

World two_shapes() {
  World world;
  world.boxes.push_back({{1.0, -1.0, 0.0}, {2.0, 1.5, 3.0}});
  world.cylinders.push_back({{-2.0, 0.5}, 0.7, 3.5, 0.5});
  return world;
}

// Steps of 1 mm until a point is inside.
double marched_distance_m(const World& world, const Vec3& from, const Vec3& direction,
                          double range_m) {
  for (double t = 0.0; t < range_m; t += 1e-3)
    if (clearance_m(world, from + t * direction) <= 0.0) return t;
  return range_m;
}

TEST(World, RaysMeetShapesWhereMarchingDoes) {
  const World world = two_shapes();
  Random random(3);
  int hits = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3 from = random_point(random, 4.0), direction = random_direction(random);
    const double expected = marched_distance_m(world, from, direction, 6.0);
    const double found = ray_distance_m(world, from, direction, 6.0);
    hits += expected < 6.0;
    // A march may step over a grazing hit of less than a step.
    if (found < expected - 2e-3) {
      EXPECT_LT(clearance_m(world, from + (found + 1e-6) * direction), 1e-3);
    } else {
      EXPECT_NEAR(found, expected, 2e-3);
    }
  }
  EXPECT_GT(hits, 50);
}

TEST(World, RayAlongAnAxisThroughACylinderIsExact) {
  World world;
  world.cylinders.push_back({{0.0, 0.0}, 0.5, 4.0});
  EXPECT_NEAR(ray_distance_m(world, {-3.0, 0.3, 1.0}, Vec3::UnitX(), 10.0), 3.0 - 0.4, 1e-12);
  EXPECT_NEAR(ray_distance_m(world, {0.1, 0.1, 6.0}, -Vec3::UnitZ(), 10.0), 2.0, 1e-12);
  EXPECT_EQ(ray_distance_m(world, {0.0, 0.0, 1.0}, Vec3::UnitX(), 10.0), 0.0);
  EXPECT_EQ(ray_distance_m(world, {-3.0, 0.6, 1.0}, Vec3::UnitX(), 10.0), 10.0);
}

TEST(World, ClearanceIsTheDistanceToTheNearestSurfacePoint) {
  const World world = two_shapes();
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const Vec3 p = random_point(random, 4.0);
    const double clearance = clearance_m(world, p);
    // No ray is shorter than the clearance, and one nearly reaches it.
    double shortest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 4000; ++k)
      shortest = std::min(shortest, ray_distance_m(world, p, random_direction(random), 1e3));
    if (clearance <= 0.0) {
      EXPECT_EQ(shortest, 0.0);
    } else {
      EXPECT_GE(shortest, clearance - 1e-9);
      EXPECT_LT(shortest, clearance * 1.15 + 0.05);
    }
  }
}

TEST(World, GroundClearanceOfALineIsTheLeastOfItsPoints) {
  const World world = two_shapes();
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const Vec2 a = random_point(random, 4.0).head<2>(), b = random_point(random, 4.0).head<2>();
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= 1000; ++k)
      least = std::min(least, ground_clearance_m(world, a + k * 1e-3 * (b - a)));
    EXPECT_NEAR(ground_clearance_m(world, a, b), least, 6e-3);
  }
}

TEST(World, SightIsBlockedExactlyByShapesBetween) {
  const World world = two_shapes();
  EXPECT_FALSE(line_of_sight(world, {0.0, 0.0, 1.0}, {3.0, 0.0, 1.0}));
  EXPECT_TRUE(line_of_sight(world, {0.0, 0.0, 1.0}, {0.9, 0.0, 1.0}));
  EXPECT_TRUE(line_of_sight(world, {0.0, 0.0, 3.1}, {3.0, 0.0, 3.1}));
}

TEST(KnownMap, CellIsOccupiedIfAndOnlyIfItOverlapsAShape) {
  World world = two_shapes();
  world.min_m = {-4.0, -3.0, 0.0};
  world.max_m = {4.0, 3.0, 5.0};
  const GridMap map = known_map(world, 0.2);
  EXPECT_EQ(map.size, Eigen::Vector3i(40, 30, 25));
  for (int z = 0; z < map.size.z(); ++z)
    for (int y = 0; y < map.size.y(); ++y)
      for (int x = 0; x < map.size.x(); ++x) {
        // The cell's nearest points to the cylinder's axis and to the box decide.
        const Vec3 low = map.origin_enu_m + 0.2 * Vec3(x, y, z), high = low + Vec3::Constant(0.2);
        const auto& b = world.boxes[0];
        bool expected =
            ((low - b.max_m).array() < -1e-9).all() && ((b.min_m - high).array() < -1e-9).all();
        const Vec2 near = Vec2(-2.0, 0.5).cwiseMax(low.head<2>()).cwiseMin(high.head<2>());
        expected |= (near - Vec2(-2.0, 0.5)).norm() < 0.7 - 1e-9 && high.z() > 0.5 + 1e-9 &&
                    low.z() < 4.0 - 1e-9;
        ASSERT_EQ(map.cells[map.offset_of({x, y, z})] != 0, expected) << x << " " << y << " " << z;
      }
  EXPECT_EQ(map.unfree_distance_cm.size(), map.cell_count());
}

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

}  // namespace
}  // namespace foretrack
