// SPDX-License-Identifier: Apache-2.0
#include "core/planning/way/waypoint_search.hpp"

#include <gtest/gtest.h>

#include <queue>

#include "core/planning/way/map_rays.hpp"
#include "tests/core/planning/planning_worlds.hpp"

namespace foretrack {
namespace {

using testing::empty_world;
using testing::FlatContext;
using testing::forest;

constexpr double kSearchHeight_m = 1.5;

double off_ring_m(const Vec3& place, const Vec3& target) {
  return std::abs(distance_xy(place, target) - 2.0);
}

double length_of(const Vec3& from, const std::vector<Vec3>& path) {
  double length_m = 0.0;
  Vec3 before = from;
  for (const Vec3& p : path) length_m += (p - before).norm(), before = p;
  return length_m;
}

// Length of the shortest way over free cell centres to a place on the ring that sees the target;
// plain Dijkstra over the whole map. Negative: there is none.
double shortest_way_m(const FlatContext& c, const Vec3& from, const Vec3& target) {
  const GridMap& map = c.map;
  std::vector<double> cost(static_cast<std::size_t>(map.size.x()) * map.size.y(), 1e9);
  const int z = map.index_of(from).z();
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const Eigen::Vector3i start = map.index_of(from);
  cost[start.y() * map.size.x() + start.x()] = 0.0;
  open.push({0.0, start.y() * map.size.x() + start.x()});
  while (!open.empty()) {
    const auto [g, n] = open.top();
    open.pop();
    if (g > cost[n]) continue;
    const Eigen::Vector3i cell(n % map.size.x(), n / map.size.x(), z);
    const Vec3 p = map.center_of(cell);
    const Vec3 at_height(p.x(), p.y(), from.z());
    if (off_ring_m(at_height, target) <= c.params.place.ring_tolerance_m &&
        sees(map, target, at_height, c.params.horizon.target_radius_m))
      return g;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const Eigen::Vector3i next = cell + Eigen::Vector3i(dx, dy, 0);
        if (!map.contains(next)) continue;
        if (map.unfree_distance_m(map.center_of(next)) < c.params.path_clearance_m() - 1e-9)
          continue;
        const double h = g + map.resolution_m * std::hypot(dx, dy);
        double& known = cost[next.y() * map.size.x() + next.x()];
        if (h < known) known = h, open.push({h, next.y() * map.size.x() + next.x()});
      }
  }
  return -1.0;
}

class WaypointSearch : public ::testing::Test {
 protected:
  WaypointKind search(const FlatContext& c, const Vec3& from, const Vec3& target,
                      int expansions_max = 5000) {
    const SearchContext context = c.context();
    path_.clear();
    begin_searches(state_, context, from);
    return search_waypoint(state_, context, from, target, 0.0, expansions_max, path_);
  }
  SearchState state_;
  std::vector<Vec3> path_;
};

TEST_F(WaypointSearch, EndsWhereTheTargetIsSeenAtTheWantedDistanceOnAFreeWayThatIsNearlyShortest) {
  int found = 0, grazing = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const FlatContext c(known_map(forest(seed, 35), 0.15), kSearchHeight_m);
    Random random(seed + 100);
    const Vec3 from(0.0, 0.0, kSearchHeight_m);
    const Vec3 target(random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0), 1.0);
    if (c.map.unfree_distance_m(from) < c.params.path_clearance_m()) continue;
    if (c.map.unfree_distance_m(target) < c.params.horizon.target_radius_m) continue;
    const double shortest_m = shortest_way_m(c, from, target);
    const WaypointKind kind = search(c, from, target);
    ASSERT_EQ(kind == WaypointKind::kSees, shortest_m >= 0.0) << "seed " << seed;
    if (kind != WaypointKind::kSees || path_.empty()) continue;
    ++found;
    EXPECT_LE(off_ring_m(path_.back(), target), c.params.place.ring_tolerance_m + 1e-9);
    grazing += !line_of_sight(c.map, target, path_.back());
    for (const Vec3& p : path_)
      EXPECT_GE(c.map.unfree_distance_m(p), c.params.path_clearance_m() - 1e-9);
    // Greed (1.15) and the price of little clearance (up to 1.5) bound what the way may be longer.
    EXPECT_LE(length_of(from, path_), 1.15 * 1.5 * shortest_m + 0.3) << "seed " << seed;
  }
  EXPECT_GT(found, 15);
  EXPECT_LE(grazing, found / 10);  // corners that are cut by less than half a cell
}

TEST_F(WaypointSearch, DoesNotSqueezeBetweenCornersThatTouch) {
  int diagonals = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const FlatContext c(known_map(forest(seed, 50), 0.15), kSearchHeight_m);
    Random random(seed + 200);
    search(c, {0.0, 0.0, kSearchHeight_m},
           {random.uniform(-6.0, 6.0), random.uniform(-6.0, 6.0), 1.0});
    for (std::size_t i = 1; i < path_.size(); ++i) {
      const Vec3 &from = path_[i - 1], &to = path_[i];
      diagonals += from.x() != to.x() && from.y() != to.y();
      for (const Vec3& side :
           {Vec3(from.x(), to.y(), kSearchHeight_m), Vec3(to.x(), from.y(), kSearchHeight_m)})
        EXPECT_GE(c.map.unfree_distance_m(side), c.params.path_clearance_m() - 1e-9);
    }
  }
  EXPECT_GT(diagonals, 100);
}

TEST_F(WaypointSearch, StaysWhereItIsIfThatIsAGoodPlace) {
  const FlatContext c(known_map(empty_world(), 0.15), kSearchHeight_m);
  EXPECT_EQ(search(c, {0.0, 0.0, kSearchHeight_m}, {2.1, 0.0, 1.0}), WaypointKind::kSees);
  EXPECT_TRUE(path_.empty());
  EXPECT_EQ(state_.expansions, 0);
}

TEST_F(WaypointSearch, InOpenSpaceExpandsOnlyAFewCellsForACellOfWay) {
  const FlatContext c(known_map(empty_world(12.0), 0.15), kSearchHeight_m);
  EXPECT_EQ(search(c, {-9.0, -3.0, kSearchHeight_m}, {6.0, 5.0, 1.0}), WaypointKind::kSees);
  EXPECT_LT(state_.expansions, 4 * static_cast<int>(length_of({-9.0, -3.0, 1.5}, path_) / 0.15));
}

TEST_F(WaypointSearch, LeavesAnInflatedObstacleWithoutComingNearer) {
  World world = empty_world();
  world.boxes.push_back({{-4.0, -4.0, 0.0}, {0.0, 4.0, 4.0}});
  const FlatContext c(known_map(world, 0.15), kSearchHeight_m);
  const Vec3 from(0.17, 0.0, kSearchHeight_m);
  ASSERT_LT(c.map.unfree_distance_m(from), 0.2);
  ASSERT_EQ(search(c, from, {4.0, 1.0, 1.0}), WaypointKind::kSees);
  double before_m = c.map.unfree_distance_m(from);
  for (const Vec3& p : path_) {
    const double clearance_m = c.map.unfree_distance_m(p);
    EXPECT_GE(clearance_m, std::min(before_m, c.params.path_clearance_m()) - 1e-9);
    before_m = clearance_m;
  }
}

TEST_F(WaypointSearch, GoesAsNearAsKnownFreeSpaceGoes) {
  const FlatContext c(
      testing::partly_known_map(empty_world(), 0.15, [](const Vec3& p) { return p.x() < 1.0; }),
      kSearchHeight_m);
  EXPECT_EQ(search(c, {-4.0, 0.0, kSearchHeight_m}, {6.0, 0.0, 1.0}, 3000), WaypointKind::kNearest);
  ASSERT_FALSE(path_.empty());
  EXPECT_NEAR(path_.back().x(), 1.0 - c.params.path_clearance_m(), 0.2);
  for (const Vec3& p : path_) EXPECT_LT(p.x(), 1.0);
}

TEST_F(WaypointSearch, StopsAtItsCountWhenTheTargetIsWalledIn) {
  World world = empty_world();
  for (const double side : {-1.0, 1.0}) {
    world.boxes.push_back(
        {{2.0 + side * 0.8 - 0.1, -0.9, 0.0}, {2.0 + side * 0.8 + 0.1, 0.9, 4.0}});
    world.boxes.push_back({{1.1, side * 0.8 - 0.1, 0.0}, {2.9, side * 0.8 + 0.1, 4.0}});
  }
  const FlatContext c(known_map(world, 0.15), kSearchHeight_m);
  EXPECT_EQ(search(c, {-4.0, 0.0, kSearchHeight_m}, {2.0, 0.0, 1.0}, 500), WaypointKind::kNearest);
  EXPECT_LE(state_.expansions, 500);
}

TEST_F(WaypointSearch, HasNoWayFromOutsideItsWindow) {
  const FlatContext c(known_map(empty_world(), 0.15), kSearchHeight_m);
  begin_searches(state_, c.context(), Vec3(0.0, 0.0, kSearchHeight_m));
  EXPECT_EQ(search_waypoint(state_, c.context(), {500.0, 0.0, kSearchHeight_m}, {0.0, 0.0, 1.0},
                            0.0, 100, path_),
            WaypointKind::kNone);
}

}  // namespace
}  // namespace foretrack
