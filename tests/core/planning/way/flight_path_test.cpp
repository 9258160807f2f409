// SPDX-License-Identifier: Apache-2.0
#include "core/planning/way/flight_path.hpp"

#include <gtest/gtest.h>

#include "core/planning/way/map_rays.hpp"
#include "tests/core/planning/planning_worlds.hpp"

namespace foretrack {
namespace {

using testing::FlatContext;

constexpr int kSteps = 15;

// A way along x with one waypoint every step_m, in cells of 0.15 m.
WaypointPath straight_way(double length_m) {
  WaypointPath way;
  const int cells = static_cast<int>(length_m / 0.15);
  for (int i = 0; i <= cells; ++i) way.points.emplace_back(-6.0 + 0.15 * i, 0.0, 1.5);
  for (int k = 1; k <= kSteps; ++k) way.arrival.push_back(cells * k / kSteps);
  return way;
}

class MakeFlightPath : public ::testing::Test {
 protected:
  void make(const FlatContext& c, const WaypointPath& way, double speed_m_s) {
    make_flight_path(c.context(), way, speed_m_s, workspace_, path_);
    ASSERT_EQ(path_.vertices.size(), path_.times_s.size());
    ASSERT_GE(path_.vertices.size(), 2U);
    ASSERT_LE(path_.vertices.size() - 1, static_cast<std::size_t>(c.params.place.polytopes_max));
    EXPECT_EQ(path_.times_s.front(), 0.0);
    for (std::size_t i = 1; i < path_.times_s.size(); ++i)
      EXPECT_GE(path_.times_s[i], path_.times_s[i - 1] + 0.2 - 1e-9);
    EXPECT_GE(path_.times_s.back(), 3.0 - 1e-9);
  }
  FlatContext open_{known_map(testing::empty_world(), 0.15), 1.5};
  FlightPathWorkspace workspace_;
  FlightPath path_;
};

TEST_F(MakeFlightPath, IsAtEachWaypointAtItsTimeIfTheVehicleCanBe) {
  make(open_, straight_way(4.5), 1.5);
  ASSERT_EQ(path_.vertices.size(), 3U);
  EXPECT_NEAR(path_.times_s[1], (path_.vertices[1].x() + 6.0) / 1.5, 0.05);
  EXPECT_NEAR(path_.times_s[2], 3.0, 1e-9);
}

TEST_F(MakeFlightPath, TakesLongerThanTheHorizonForAWayThatIsTooLong) {
  make(open_, straight_way(12.0), 0.0);
  EXPECT_GT(path_.times_s.back(), 3.2);
  const double way_m = (path_.vertices.back() - path_.vertices.front()).norm();
  EXPECT_LT(way_m, 3.0 * path_.times_s.back());
}

TEST_F(MakeFlightPath, StandsForTheWholeHorizonIfThereIsNoWay) {
  WaypointPath way;
  way.points = {{1.0, 2.0, 1.5}};
  way.arrival.assign(kSteps, 0);
  make(open_, way, 0.0);
  EXPECT_EQ(path_.vertices.size(), 2U);
  EXPECT_EQ(path_.vertices[0], path_.vertices[1]);
}

TEST_F(MakeFlightPath, StraightensAWayOnlyWhereThatIsClear) {
  World world = testing::empty_world();
  world.boxes.push_back({{-1.0, -1.0, 0.0}, {1.0, 1.0, 4.0}});
  const FlatContext c(known_map(world, 0.15), 1.5);
  WaypointPath way;
  for (double x = -2.25; x < 0.0; x += 0.15) way.points.emplace_back(x, -1.8, 1.5);
  for (double x = 0.0; x <= 1.8; x += 0.15) way.points.emplace_back(x, -1.8, 1.5);
  for (double y = -1.8; y <= 1.8; y += 0.15) way.points.emplace_back(1.8, y, 1.5);
  for (int k = 1; k <= kSteps; ++k)
    way.arrival.push_back(static_cast<int>(way.points.size() - 1) * k / kSteps);
  make(c, way, 1.5);
  for (std::size_t i = 0; i + 1 < path_.vertices.size(); ++i)
    EXPECT_TRUE(is_clear(c.map, path_.vertices[i], path_.vertices[i + 1],
                         c.params.path_clearance_m() - 1e-9));
  EXPECT_EQ(path_.vertices.back(), way.points.back());
}

}  // namespace
}  // namespace foretrack
