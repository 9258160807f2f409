// SPDX-License-Identifier: Apache-2.0
// What moves against the map is seen in depth, and the map forgets it.
#include <gtest/gtest.h>

#include "core/common/random.hpp"
#include "core/mapping/update_map.hpp"
#include "tests/core/mapping/box_world.hpp"
#include "tests/support/count_allocations.hpp"

namespace foretrack {
namespace {

using test::Box;
using test::World;

constexpr double kFrame_s = 1.0 / 15.0;
constexpr double kBodyRadius_m = 0.25, kBodyHeight_m = 1.75;
const World kRoom = {{{-20, -20, -0.3}, {20, 20, -0.001}},
                     {{6.0, -6.0, 0.0}, {6.3, 6.0, 3.0}},
                     {{1.5, 2.5, 0.0}, {5.0, 2.7, 3.0}},
                     {{3.0, -2.6, 0.0}, {3.1, -2.5, 3.0}}};

/// A vehicle that looks at a room in which cylinders walk, with a depth camera's noise.
struct Room {
  MappingParams params;
  MappingState state{params};
  VehicleHistory history;
  Random random{3};
  double now_s = 0.0;
  Vec3 vehicle_m{0.0, 0.0, 1.4};
  double yaw_rad = 0.0;
  DepthImage drawn;
  Vec3 drawn_from_m = Vec3::Zero();
  double drawn_yaw_rad = 0.0;

  MapUpdate look(const std::vector<Vec2>& walkers, std::span<const MovingBody> known = {}) {
    now_s += kFrame_s;
    const VehicleState vehicle = test::vehicle_at(now_s, vehicle_m, yaw_rad);
    history.add(vehicle);
    DepthImage image = room_from(vehicle);
    for (const Vec2& walker : walkers) draw(walker, vehicle, image);
    for (float& depth : image.depth_m)
      if (std::isfinite(depth)) {
        const double far = std::max(1.0, depth / 4.0);
        depth += static_cast<float>(0.02 * far * far * random.normal());
      }
    return update_map(state, image, history, known, params);
  }
  // Drawn anew only where the vehicle has moved.
  const DepthImage& room_from(const VehicleState& vehicle) {
    if (vehicle_m != drawn_from_m || yaw_rad != drawn_yaw_rad || drawn.depth_m.empty())
      drawn = test::render(kRoom, vehicle);
    drawn_from_m = vehicle_m;
    drawn_yaw_rad = yaw_rad;
    drawn.stamp_s = vehicle.stamp_s;
    return drawn;
  }
  // An upright cylinder, seen by a level camera: a column of the image has one depth.
  static void draw(const Vec2& at, const VehicleState& vehicle, DepthImage& image) {
    const CameraModel& c = image.camera;
    const Pose T = vehicle.T_world_body() * c.T_body_camera;
    for (int u = 0; u < c.width_px; ++u) {
      const Vec3 ray = T.linear() * Vec3((u + 0.5 - c.cx_px) / c.fx_px, 0.0, 1.0);
      const Vec2 way = ray.head<2>(), from = T.translation().head<2>() - at;
      const double a = way.squaredNorm(), b = from.dot(way);
      const double root = b * b - a * (from.squaredNorm() - kBodyRadius_m * kBodyRadius_m);
      const double depth_m = root < 0.0 ? -1.0 : (-b - std::sqrt(root)) / a;
      if (depth_m <= 0.0) continue;
      for (int v = 0; v < c.height_px; ++v) {
        const double z_m = T.translation().z() - depth_m * (v + 0.5 - c.cy_px) / c.fy_px;
        float& pixel = image.depth_m[static_cast<std::size_t>(v) * c.width_px + u];
        if (z_m > 0.0 && z_m < kBodyHeight_m) pixel = std::min(pixel, static_cast<float>(depth_m));
      }
    }
  }
  const BodySightings& movers() const { return state.movers; }
  /// Occupied cells within a body's room at this place, from the knee to the head.
  int occupied_at(const Vec2& place) const {
    const GridMap& map = local_map(state);
    int count = 0;
    for (double z = 0.4; z < 1.7; z += 0.15)
      for (double x = -0.3; x <= 0.3; x += 0.15)
        for (double y = -0.3; y <= 0.3; y += 0.15)
          count += map.is_occupied({place.x() + x, place.y() + y, z});
    return count;
  }
};

TEST(Movers, AStandingWorldHasNone) {
  Room room;
  for (int k = 0; k < 45; ++k) {
    room.vehicle_m = {0.04 * k, -0.02 * k, 1.4 + 0.2 * std::sin(0.2 * k)};
    room.yaw_rad = 0.5 * std::sin(0.3 * k);
    room.look({});
    EXPECT_EQ(room.movers().count, 0) << k;
  }
}

TEST(Movers, AWalkerIsSeenWhereItIs) {
  for (const double speed_m_s : {1.0, 2.0, 3.0}) {
    Room room;
    for (int k = 0; k < 10; ++k) room.look({});
    double first_y = NAN, worst_m = 0.0;
    for (double y = -1.8; y < 1.8; y += speed_m_s * kFrame_s) {
      room.look({{2.5, y}});
      ASSERT_LE(room.movers().count, 1);
      if (room.movers().count == 0) continue;
      const BodySighting& body = room.movers().bodies[0];
      if (std::isnan(first_y)) first_y = y;
      worst_m = std::max(worst_m, (body.position_enu_m.head<2>() - Vec2(2.5, y)).norm());
      EXPECT_EQ(body.kind, BodyKind::kUnknown);
      EXPECT_NEAR(body.radius_m, kBodyRadius_m, 0.1);
      EXPECT_NEAR(body.position_enu_m.z() + body.height_m, kBodyHeight_m, 0.15);
    }
    EXPECT_LE(first_y, -1.8 + speed_m_s * 0.3 + 0.1) << "seen in time at " << speed_m_s;
    EXPECT_LT(worst_m, 0.2) << speed_m_s;
  }
}

TEST(Movers, OneWhoComesNearIsSeen) {
  Room room;
  for (int k = 0; k < 10; ++k) room.look({});
  int seen = 0, looks = 0;
  for (double x = 5.0; x > 1.5; x -= 1.5 * kFrame_s, ++looks) {
    room.look({{x, 0.3}});
    seen += room.movers().count == 1;
  }
  EXPECT_GE(seen, looks - 2);
}

TEST(Movers, WhoStandsForLongIsPartOfTheWorld) {
  Room room;
  for (int k = 0; k < 10; ++k) room.look({});
  for (int k = 0; k < 15 * (room.params.mover_lately_s + 0.3); ++k) room.look({{2.5, 0.3}});
  EXPECT_EQ(room.movers().count, 0);
  EXPECT_GT(room.occupied_at({2.5, 0.3}), 5) << "an obstacle";
}

TEST(Movers, TheMapForgetsWhoHasWalkedOn) {
  Room room;
  for (int k = 0; k < 10; ++k) room.look({});
  for (int k = 0; k < 45; ++k) room.look({{2.5, -0.8}});
  ASSERT_GT(room.occupied_at({2.5, -0.8}), 5);
  double y = -0.8;
  for (; y < 0.2; y += 1.0 * kFrame_s) room.look({{2.5, y}});
  const Vec2 here(2.5, y);
  for (int k = 0; k < 9; ++k) room.look({here});  // 0.6 s
  EXPECT_EQ(room.occupied_at({2.5, -0.8}), 0) << "where it stood";
  EXPECT_EQ(room.occupied_at({2.5, -0.35}), 0) << "on its way";
}

TEST(Movers, AKnownBodyThatMovesLeavesNoGhost) {
  for (const bool followed : {false, true}) {
    Room room;
    for (int k = 0; k < 10; ++k) room.look({});
    std::array<MovingBody, 1> known;
    known[0].followed = followed;
    known[0].kind = followed ? BodyKind::kPerson : BodyKind::kUnknown;
    known[0].velocity_enu_m_s = {0.0, 1.5, 0.0};
    for (double y = -1.5; y < 1.5; y += 1.5 * kFrame_s) {
      known[0].stamp_s = room.now_s + kFrame_s;
      known[0].position_enu_m = {2.5, y + 0.08, 0.0};  // as well as it is known
      room.look({{2.5, y}}, known);
      EXPECT_EQ(room.movers().count, followed ? 0 : 1);
      for (double trail = -1.5; trail <= y; trail += 0.3)
        ASSERT_EQ(room.occupied_at({2.5, trail}), 0) << y << " at " << trail;
    }
  }
}

TEST(Movers, APersonWhoWasAnObstacleBeforeTheyWereKnownIsNoneWhereTheyStand) {
  Room room;
  for (int k = 0; k < 5; ++k) room.look({{2.5, 0.0}});
  ASSERT_GT(room.occupied_at({2.5, 0.0}), 5);
  std::array<MovingBody, 1> person;
  person[0].followed = true;
  person[0].kind = BodyKind::kPerson;
  person[0].position_enu_m = {2.5, 0.05, 0.0};
  for (int k = 0; k < 15; ++k) room.look({{2.5, 0.0}}, person);
  EXPECT_EQ(room.occupied_at({2.5, 0.0}), 0);
}

TEST(Movers, ABodyThatHasStoppedIsAnObstacleUnlessItIsAPerson) {
  for (const BodyKind kind : {BodyKind::kUnknown, BodyKind::kPerson}) {
    Room room;
    for (int k = 0; k < 10; ++k) room.look({});
    std::array<MovingBody, 1> known;
    known[0].kind = kind;
    known[0].position_enu_m = {2.5, 0.0, 0.0};
    for (int k = 0; k < 10; ++k) room.look({{2.5, 0.0}}, known);
    if (kind == BodyKind::kPerson)
      EXPECT_EQ(room.occupied_at({2.5, 0.0}), 0);
    else
      EXPECT_GT(room.occupied_at({2.5, 0.0}), 5);
  }
}

TEST(Movers, TwoWhoWalkApartAreTwo) {
  Room room;
  for (int k = 0; k < 10; ++k) room.look({});
  int both = 0, looks = 0;
  for (double y = -1.5; y < 1.5; y += 1.2 * kFrame_s, ++looks) {
    room.look({{2.0, y}, {3.5, -0.7 * y + 0.9}});
    both += room.movers().count == 2;
  }
  EXPECT_GT(both, looks / 2) << "one hides the other at times";
}

TEST(Movers, AllocatesNothingWhileSomebodyWalks) {
  Room room;
  for (int k = 0; k < 10; ++k) room.look({});
  for (int pass = 0; pass < 2; ++pass)
    for (double y = -1.5; y < 1.5; y += 1.5 * kFrame_s) room.look({{2.5, y}});
  MoverColumns& columns = room.state.mover_columns;
  const GridMap& map = local_map(room.state);
  BodySightings found;
  const long before = allocation_count();
  for (double z = 0.2; z < 1.7; z += 0.05)
    for (double y = -0.2; y < 0.2; y += 0.05) add_return(columns, map, {2.5, y, z});
  find_movers(columns, map, room.vehicle_m, room.params, found);
  EXPECT_EQ(allocation_count(), before);
  EXPECT_EQ(found.count, 1);
}

}  // namespace
}  // namespace foretrack
