// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/update_map.hpp"

#include <gtest/gtest.h>

#include "core/mapping/octree_cells.hpp"
#include "tests/core/mapping/box_world.hpp"
#include "tests/support/count_allocations.hpp"

namespace foretrack {
namespace {

using test::Box;
using test::render;
using test::vehicle_at;
using test::World;
using Vec3i = Eigen::Vector3i;

const Box kWall{{3.0, -4.0, 0.0}, {3.4, 4.0, 3.0}};
const Box kFloor{{-20.0, -20.0, -0.3}, {20.0, 20.0, -0.001}};
const Box kPillar{{2.0, 0.8, 0.0}, {2.3, 1.1, 3.0}};
const Vec3 kStart(0.0, 0.0, 1.4);

/// A vehicle that maps a world, one image a call.
struct Mapper {
  MappingParams params;
  MappingState state{params};
  VehicleHistory history;
  double now_s = 0.0;

  MapUpdate look(const World& world, const Vec3& position = kStart, double yaw_rad = 0.0,
                 std::span<const MovingBody> bodies = {}) {
    now_s += 1.0 / 15.0;
    const VehicleState vehicle = vehicle_at(now_s, position, yaw_rad);
    history.add(vehicle);
    return update_map(state, render(world, vehicle), history, bodies, params);
  }
  Cell at(double x, double y, double z) const { return local_map(state).cell_at({x, y, z}); }
};

template <class Visit>
void for_each_cell(const GridMap& map, Visit&& visit) {
  for (int z = 0; z < map.size.z(); ++z)
    for (int y = 0; y < map.size.y(); ++y)
      for (int x = 0; x < map.size.x(); ++x) visit(Vec3i(x, y, z));
}

TEST(UpdateMap, WallIsOccupiedBeforeItFreeAndBehindItUnknown) {
  Mapper m;
  const MapUpdate update = m.look({kWall});
  EXPECT_EQ(update.status, MapStatus::kUpdated);
  EXPECT_GT(update.hits, 3000);
  EXPECT_EQ(m.at(3.05, 0.0, 1.4), Cell::kOccupied);
  EXPECT_EQ(m.at(3.05, 1.5, 0.6), Cell::kOccupied);
  EXPECT_EQ(m.at(2.0, 0.0, 1.4), Cell::kFree);
  EXPECT_EQ(m.at(2.0, 1.0, 0.8), Cell::kFree);
  EXPECT_EQ(m.at(4.0, 0.0, 1.4), Cell::kUnknown);
  EXPECT_EQ(m.at(-3.0, 0.0, 1.4), Cell::kUnknown);
}

TEST(UpdateMap, AgreesWithTheWorldCellByCell) {
  const World world = {kWall, kFloor, kPillar};
  Mapper m;
  for (int k = 0; k < 5; ++k) m.look(world, kStart + Vec3(0.02 * k, 0.1 * k, 0), 0.05 * k);
  const GridMap& map = local_map(m.state);
  int occupied = 0, free = 0;
  const Vec3 half = Vec3::Constant(0.5 * map.resolution_m);
  for_each_cell(map, [&](const Vec3i& i) {
    const Vec3 centre = map.center_of(i);
    const Cell cell = map.cell_at(centre);
    // Occupied cells meet a box; the centres of free cells are in none.
    if (cell == Cell::kOccupied) {
      ++occupied;
      EXPECT_TRUE(std::any_of(world.begin(), world.end(), [&](const Box& b) {
        return ((centre + half).array() >= b.low.array() - 1e-4).all() &&
               ((centre - half).array() <= b.high.array() + 1e-4).all();
      })) << centre.transpose();
    }
    if (cell == Cell::kFree) {
      ++free;
      EXPECT_FALSE(std::any_of(world.begin(), world.end(), [&](const Box& b) {
        return b.contains(centre);
      })) << centre.transpose();
    }
  });
  EXPECT_GT(occupied, 800);
  EXPECT_GT(free, 5000);
}

TEST(UpdateMap, SeesEveryCellOfAWallInView) {
  Mapper m;
  m.look({kWall});
  for (double y = -1.9; y < 1.9; y += 0.15)
    for (double z = 0.3; z < 2.5; z += 0.15) EXPECT_EQ(m.at(3.05, y, z), Cell::kOccupied);
}

TEST(UpdateMap, ThinPoleIsNotMissed) {
  Mapper m;
  m.look({Box{{4.0, 0.5, 0.0}, {4.06, 0.56, 3.0}}});
  for (double z = 0.5; z < 2.4; z += 0.15) EXPECT_EQ(m.at(4.01, 0.51, z), Cell::kOccupied) << z;
}

TEST(UpdateMap, WhatMovedAwayIsCleared) {
  Mapper m;
  for (int k = 0; k < 15; ++k) m.look({kWall, kPillar});
  ASSERT_EQ(m.at(2.05, 0.95, 1.4), Cell::kOccupied);
  for (int k = 0; k < 10; ++k) m.look({kWall});
  EXPECT_EQ(m.at(2.05, 0.95, 1.4), Cell::kFree);
  EXPECT_EQ(m.at(3.05, 0.0, 1.4), Cell::kOccupied);
}

TEST(UpdateMap, NothingInRangeFreesUpToTheRange) {
  Mapper m;
  m.look({});
  EXPECT_EQ(m.at(5.5, 0.0, 1.4), Cell::kFree);
  EXPECT_EQ(m.at(6.3, 0.0, 1.4), Cell::kUnknown);
}

TEST(UpdateMap, PixelsWithoutReturnSayNothing) {
  for (const float nothing : {0.0f, std::numeric_limits<float>::quiet_NaN(), -1.0f}) {
    Mapper m;
    VehicleState vehicle = vehicle_at(0.0, kStart);
    m.history.add(vehicle);
    DepthImage image = render({}, vehicle);
    std::fill(image.depth_m.begin(), image.depth_m.end(), nothing);
    const MapUpdate update = update_map(m.state, image, m.history, {}, m.params);
    EXPECT_EQ(update.rays, 0);
    EXPECT_EQ(update.hits, 0);
    EXPECT_EQ(m.at(2.0, 0.0, 1.4), Cell::kUnknown);
  }
}

MovingBody followed_at(const Vec3& foot_enu_m) {
  MovingBody person;
  person.kind = BodyKind::kPerson;
  person.followed = true;
  person.position_enu_m = foot_enu_m;
  return person;
}

TEST(UpdateMap, PersonIsNoObstacleAndHidesNothingThatWasKnown) {
  const Box body{{1.9, -0.2, 0.0}, {2.1, 0.2, 1.75}};
  const std::array<MovingBody, 1> person = {followed_at({2.0, 0.0, 0.0})};
  Mapper m;
  m.look({kWall});
  m.look({kWall, body}, kStart, 0.0, person);
  EXPECT_NE(m.at(1.92, 0.0, 1.2), Cell::kOccupied);
  EXPECT_EQ(m.at(1.2, 0.0, 1.2), Cell::kFree);
  EXPECT_EQ(m.at(3.05, 0.0, 1.4), Cell::kOccupied);
  // Nobody knows of a person there any more.
  for (int k = 0; k < 10; ++k) m.look({kWall, body});
  EXPECT_EQ(m.at(1.92, 0.0, 1.2), Cell::kOccupied);
}

TEST(UpdateMap, PersonIsCutOutWhereTheyAreAtTheImagesStamp) {
  const Box body{{1.9, -0.2, 0.0}, {2.1, 0.2, 1.75}};
  const Vec3 velocity(0.0, 2.0, 0.0);
  std::array<MovingBody, 1> person = {followed_at(Vec3(2, 0, 0) - (0.5 + 1.0 / 15.0) * velocity)};
  person[0].stamp_s = -0.5;
  person[0].velocity_enu_m_s = velocity;
  Mapper m;
  m.look({kWall, body}, kStart, 0.0, person);
  EXPECT_NE(m.at(1.92, 0.0, 1.2), Cell::kOccupied);
}

TEST(UpdateMap, UsesTheVehiclesPoseAtTheImagesStamp) {
  Mapper m;
  for (int k = 0; k <= 10; ++k) m.history.add(vehicle_at(0.1 * k, kStart, 0.15 * k));
  const DepthImage image = render({kWall}, vehicle_at(0.25, kStart, 0.375));
  update_map(m.state, image, m.history, {}, m.params);
  EXPECT_EQ(m.at(3.05, 0.0, 1.4), Cell::kOccupied);
  EXPECT_EQ(m.at(2.5, 0.0, 1.4), Cell::kFree);
  EXPECT_EQ(m.at(2.5, 1.5, 1.4), Cell::kFree);
}

TEST(UpdateMap, VehicleIsInAFreeBubbleUnlessSomethingIsThere) {
  Mapper m;
  m.look({Box{{0.3, -1.0, 0.0}, {0.32, 1.0, 3.0}}});
  EXPECT_EQ(m.at(0.0, 0.0, 1.4), Cell::kFree);
  EXPECT_EQ(m.at(-0.45, 0.0, 1.4), Cell::kFree);
  EXPECT_EQ(m.at(-0.75, 0.0, 1.4), Cell::kFree);  // it starts here
  EXPECT_EQ(m.at(-1.05, 0.0, 1.4), Cell::kUnknown);
  EXPECT_EQ(m.at(0.31, 0.0, 1.4), Cell::kOccupied);
}

// Nobody promised that there is room beside it.
TEST(UpdateMap, WhereItStartsThereIsRoomBeforeTheCameraOnly) {
  Mapper m;
  m.look({});
  EXPECT_EQ(m.at(0.75, 0.75, 1.4), Cell::kFree);
  EXPECT_EQ(m.at(0.0, 1.05, 1.4), Cell::kUnknown);
  EXPECT_EQ(m.at(-0.75, 0.75, 1.4), Cell::kUnknown);
}

// What is seen begins as a narrow cone. A planner does not come nearer to what is unknown than it
// is: without room before the camera a vehicle that hovers had no way into the space that it looks
// at.
TEST(UpdateMap, WhereverItHoversTheWayBeforeTheCameraIsAsWideAsItsPlace) {
  Mapper m;
  m.look({kFloor});
  const Vec3 aside = kStart + Vec3(-3.0, 0.6, 0.0);
  m.look({kFloor}, aside, kPi);
  const GridMap& map = local_map(m.state);
  for (double way_m = 0.0; way_m < 3.0; way_m += 0.1)
    EXPECT_GE(map.unfree_distance_m(aside - Vec3(way_m, 0, 0)), map.unfree_distance_m(aside))
        << way_m << " m ahead";
}

TEST(UpdateMap, RoomBeforeTheCameraNeverHidesWhatIsSeenThere) {
  const Box near{{0.7, -0.3, 1.0}, {0.9, 0.3, 1.8}};
  Mapper m;
  m.look({near});
  EXPECT_EQ(m.at(0.70, 0.0, 1.4), Cell::kOccupied);
}

int cells_that_differ_from_the_octree(const MappingState& state) {
  const GridMap& map = local_map(state);
  int differing = 0;
  for_each_cell(map, [&](const Vec3i& i) {
    const auto* node = state.tree->search(key_of(state.base + i));
    const Cell stored = node == nullptr                     ? Cell::kUnknown
                        : state.tree->isNodeOccupied(*node) ? Cell::kOccupied
                                                            : Cell::kFree;
    differing += static_cast<Cell>(map.cells[map.offset_of(i)]) != stored;
  });
  return differing;
}

TEST(UpdateMap, OctreeHoldsTheSameAsTheBoxWhereverTheVehicleFlies) {
  const World world = {kWall, kFloor, kPillar, Box{{-3, -9, 0}, {-2.5, 9, 2}}};
  Mapper m;
  int scrolls = 0;
  for (int k = 0; k < 40; ++k) {
    const double a = 0.3 * k;
    const Vec3 place(6.0 * std::sin(a), 4.0 * std::sin(2.0 * a), 1.4 + 0.8 * std::sin(a));
    scrolls += m.look(world, place, a).scrolled;
    const GridMap& map = local_map(m.state);
    EXPECT_LE(
        (place - (map.origin_enu_m + 0.5 * 0.15 * map.size.cast<double>())).cwiseAbs().maxCoeff(),
        m.params.scroll_step_m + 0.08);
    if (k % 10 != 9) continue;
    EXPECT_EQ(cells_that_differ_from_the_octree(m.state), 0) << k;
  }
  EXPECT_GT(scrolls, 20);
}

TEST(UpdateMap, RemembersWhereItComesBackTo) {
  Mapper m;
  for (int k = 0; k < 8; ++k) m.look({kWall, kFloor});
  const GridMap before = local_map(m.state);
  for (double x = 0.0; x > -20.0; x -= 0.7) m.look({}, kStart + Vec3(x, 0, 0), kPi);
  EXPECT_FALSE(local_map(m.state).contains(Vec3(3.05, 0.0, 1.4)));
  for (double x = -20.0; x < 0.0; x += 0.7) m.look({}, kStart + Vec3(x, 0, 0), kPi);
  m.look({kWall, kFloor});
  int differing = 0;
  for_each_cell(before, [&](const Vec3i& i) {
    const Vec3 p = before.center_of(i);
    if (before.cell_at(p) == Cell::kOccupied && p.x() > 1.0)
      differing += local_map(m.state).contains(p) && m.at(p.x(), p.y(), p.z()) != Cell::kOccupied;
  });
  EXPECT_EQ(differing, 0);
}

TEST(UpdateMap, DistancesAreThoseOfTheCells) {
  Mapper m;
  m.look({kWall, kFloor});
  GridMap again = local_map(m.state);
  DistanceWorkspace workspace;
  update_distances(again, workspace);
  EXPECT_EQ(local_map(m.state).occupied_distance_cm, again.occupied_distance_cm);
  EXPECT_EQ(local_map(m.state).unfree_distance_cm, again.unfree_distance_cm);
  EXPECT_GT(local_map(m.state).unfree_distance_m({1.5, 0.0, 1.4}), 0.4);
}

TEST(UpdateMap, OctreeStaysSmallByPruning) {
  Mapper m;
  for (int k = 0; k < 30; ++k) m.look({kWall, kFloor}, kStart, 0.2 * k);
  const auto& cells = local_map(m.state).cells;
  const auto known = std::count_if(cells.begin(), cells.end(), [](auto c) { return c != 2; });
  EXPECT_LT(static_cast<double>(m.state.tree->getNumLeafNodes()), 0.5 * static_cast<double>(known));
}

TEST(UpdateMap, AllocatesNothingWhereTheWorldIsKnown) {
  Mapper m;
  for (int k = 0; k < 5; ++k) m.look({kWall, kFloor});
  const VehicleState vehicle = vehicle_at(m.now_s + 0.05, kStart);
  m.history.add(vehicle);
  const DepthImage image = render({kWall, kFloor}, vehicle);
  const long before = allocation_count();
  update_map(m.state, image, m.history, {}, m.params);
  EXPECT_EQ(allocation_count(), before);
}

TEST(UpdateMap, NamesEachReasonForRefusal) {
  Mapper m;
  const VehicleState vehicle = vehicle_at(0.0, kStart);
  DepthImage image = render({}, vehicle);
  EXPECT_EQ(update_map(m.state, image, VehicleHistory(), {}, m.params).status,
            MapStatus::kNoVehiclePose);
  EXPECT_TRUE(local_map(m.state).empty());
  m.history.add(vehicle);
  image.depth_m.pop_back();
  EXPECT_EQ(update_map(m.state, image, m.history, {}, m.params).status, MapStatus::kInvalidImage);
}

TEST(BodiesAt, AreNoneWhenTheyAreStale) {
  MappingParams params;
  params.bodies_stale_s = 0.5;
  MovingBodies bodies;
  bodies.stamp_s = 10.0;
  bodies.add({});
  for (const double stamp_s : {9.6, 10.0, 10.4})
    EXPECT_EQ(bodies_at(stamp_s, bodies, params).size(), 1u) << stamp_s;
  for (const double stamp_s : {9.4, 10.6})
    EXPECT_TRUE(bodies_at(stamp_s, bodies, params).empty()) << stamp_s;
}

}  // namespace
}  // namespace foretrack
