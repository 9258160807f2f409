// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/world.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/common/random.hpp"

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

}  // namespace
}  // namespace foretrack
