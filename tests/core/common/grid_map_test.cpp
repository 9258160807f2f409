// SPDX-License-Identifier: Apache-2.0
#include "core/common/grid_map.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

using Vec3i = Eigen::Vector3i;

GridMap random_map(std::uint64_t seed, const Vec3i& size, double resolution_m, double occupied,
                   double unknown) {
  Random random(seed);
  GridMap map;
  map.resolution_m = resolution_m;
  map.origin_enu_m = Vec3(-1.5, 0.3, -0.6);
  map.size = size;
  map.cells.resize(map.cell_count());
  for (auto& cell : map.cells) {
    const double draw = random.uniform();
    cell = static_cast<std::uint8_t>(draw < occupied             ? Cell::kOccupied
                                     : draw < occupied + unknown ? Cell::kUnknown
                                                                 : Cell::kFree);
  }
  return map;
}

template <class Visit>
void for_each_cell(const GridMap& map, Visit&& visit) {
  for (int z = 0; z < map.size.z(); ++z)
    for (int y = 0; y < map.size.y(); ++y)
      for (int x = 0; x < map.size.x(); ++x) visit(Vec3i(x, y, z));
}

Cell cell_of(const GridMap& map, const Vec3i& i) {
  return static_cast<Cell>(map.cells[map.offset_of(i)]);
}

// From the centre of `i` to the nearest point of any cell for which is_source.
template <class IsSource>
double brute_distance_m(const GridMap& map, const Vec3i& i, IsSource&& is_source) {
  double least = 2.55;
  for_each_cell(map, [&](const Vec3i& j) {
    if (!is_source(cell_of(map, j))) return;
    const Vec3 gap = ((i - j).cwiseAbs().cast<double>().array() - 0.5).cwiseMax(0.0);
    least = std::min(least, i == j ? 0.0 : map.resolution_m * gap.norm());
  });
  return least;
}

void expect_distances_are_exact(GridMap map) {
  DistanceWorkspace workspace;
  update_distances(map, workspace);
  for_each_cell(map, [&](const Vec3i& i) {
    const Vec3 p = map.center_of(i);
    const double occupied = brute_distance_m(map, i, [](Cell c) { return c == Cell::kOccupied; });
    const double unfree = brute_distance_m(map, i, [](Cell c) { return c != Cell::kFree; });
    // Rounded down to a centimetre, so never more than the truth.
    ASSERT_LE(map.occupied_distance_m(p), occupied + 1e-9);
    ASSERT_GT(map.occupied_distance_m(p), occupied - 0.01001);
    ASSERT_LE(map.unfree_distance_m(p), unfree + 1e-9);
    ASSERT_GT(map.unfree_distance_m(p), unfree - 0.01001);
  });
}

TEST(GridMap, DistancesAreThoseOfBruteForce) {
  expect_distances_are_exact(random_map(1, {23, 17, 11}, 0.15, 0.01, 0.02));
  expect_distances_are_exact(random_map(2, {12, 31, 9}, 0.2, 0.002, 0.0));
  expect_distances_are_exact(random_map(3, {33, 9, 7}, 0.05, 0.001, 0.001));
  expect_distances_are_exact(random_map(4, {5, 6, 7}, 0.3, 0.0, 0.0));
  expect_distances_are_exact(random_map(5, {70, 3, 3}, 0.05, 0.01, 0.0));
}

TEST(GridMap, DistancesFollowAChangeOfTheMap) {
  GridMap map = random_map(6, {10, 10, 5}, 0.15, 0.0, 0.1);
  DistanceWorkspace workspace;
  update_distances(map, workspace);
  std::fill(map.cells.begin(), map.cells.end(), static_cast<std::uint8_t>(Cell::kFree));
  update_distances(map, workspace);
  EXPECT_DOUBLE_EQ(map.unfree_distance_m(map.center_of({5, 5, 2})), 2.55);
}

TEST(GridMap, OutsideIsUnknownAndMayNotBeEntered) {
  GridMap map = random_map(7, {4, 4, 4}, 0.5, 0.0, 0.0);
  DistanceWorkspace workspace;
  update_distances(map, workspace);
  const Vec3 outside = map.origin_enu_m - Vec3(0.01, 0, 0);
  EXPECT_EQ(map.cell_at(outside), Cell::kUnknown);
  EXPECT_EQ(map.unfree_distance_m(outside), 0.0);
  EXPECT_DOUBLE_EQ(map.occupied_distance_m(outside), 2.55);
  EXPECT_FALSE(map.is_occupied(outside));
}

TEST(GridMap, IndexAndCentreRoundTrip) {
  const GridMap map = random_map(8, {7, 8, 9}, 0.15, 0.1, 0.1);
  for_each_cell(map, [&](const Vec3i& i) { EXPECT_EQ(map.index_of(map.center_of(i)), i); });
}

// Length of the segment inside an occupied cell, over all cells (slab method).
double occupied_length_m(const GridMap& map, const Vec3& from, const Vec3& to, double& first_m) {
  const Vec3 span = to - from;
  double total = 0.0;
  first_m = span.norm();
  for_each_cell(map, [&](const Vec3i& i) {
    if (cell_of(map, i) != Cell::kOccupied) return;
    double enter = 0.0, leave = 1.0;
    for (int a = 0; a < 3; ++a) {
      const double low = map.origin_enu_m[a] + map.resolution_m * i[a];
      const double t0 = (low - from[a]) / span[a];
      const double t1 = (low + map.resolution_m - from[a]) / span[a];
      enter = std::max(enter, std::min(t0, t1));
      leave = std::min(leave, std::max(t0, t1));
    }
    if (leave <= enter) return;
    total += (leave - enter) * span.norm();
    first_m = std::min(first_m, enter * span.norm());
  });
  return total;
}

TEST(GridMap, LineOfSightIsThatOfBruteForce) {
  const GridMap map = random_map(9, {20, 20, 10}, 0.15, 0.01, 0.3);
  const Vec3 extent = 0.15 * map.size.cast<double>();
  Random random(10);
  int blocked = 0, grazing = 0;
  for (int k = 0; k < 2000; ++k) {
    Vec3 ends[2];
    for (Vec3& end : ends)  // some lie outside the grid
      for (int a = 0; a < 3; ++a)
        end[a] = map.origin_enu_m[a] + extent[a] * random.uniform(-0.2, 1.2);
    double first_m = 0.0;
    const double inside_m = occupied_length_m(map, ends[0], ends[1], first_m);
    if (inside_m > 0.0 && inside_m < 1e-6) {
      ++grazing;
      continue;
    }
    EXPECT_EQ(line_of_sight(map, ends[0], ends[1]), inside_m == 0.0);
    const Vec3 span = ends[1] - ends[0];
    EXPECT_NEAR(ray_distance_m(map, ends[0], span.normalized(), span.norm()), first_m, 1e-9);
    blocked += inside_m > 0.0;
  }
  EXPECT_GT(blocked, 200);
  EXPECT_LT(blocked, 1800);
  EXPECT_LT(grazing, 20);
}

TEST(GridMap, SightAlongAnAxisStopsAtAWall) {
  GridMap map = random_map(11, {10, 10, 10}, 0.1, 0.0, 0.0);
  map.cells[map.offset_of({7, 5, 5})] = static_cast<std::uint8_t>(Cell::kOccupied);
  const Vec3 from = map.center_of({2, 5, 5});
  EXPECT_FALSE(line_of_sight(map, from, map.center_of({9, 5, 5})));
  EXPECT_TRUE(line_of_sight(map, from, map.center_of({6, 5, 5})));
  EXPECT_TRUE(line_of_sight(map, from, from));
  EXPECT_NEAR(ray_distance_m(map, from, Vec3::UnitX(), 3.0), 0.45, 1e-9);
  EXPECT_NEAR(ray_distance_m(map, from, Vec3::UnitY(), 3.0), 3.0, 1e-9);
}

TEST(GridMap, UnknownCellsDoNotBlockSight) {
  const GridMap map = random_map(12, {10, 10, 10}, 0.1, 0.0, 1.0);
  EXPECT_TRUE(line_of_sight(map, map.center_of({0, 0, 0}), map.center_of({9, 8, 7})));
}

}  // namespace
}  // namespace foretrack
