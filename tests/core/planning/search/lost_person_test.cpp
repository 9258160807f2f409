// SPDX-License-Identifier: Apache-2.0
#include "core/planning/search/lost_person.hpp"

#include <gtest/gtest.h>

#include "tests/core/planning/search/search_world.hpp"
#include "tests/support/count_allocations.hpp"

namespace foretrack {
namespace {

// Somebody went in at x = 0 with 1.2 m/s; the vehicle stands before the wall and looks along it.
struct Search {
  GridMap map;
  LostPerson lost;
  PlanningParams params;
  VehicleState vehicle = testing::hovering({-2.0, -1.5, 1.3}, 0.3, 0.0);
  double now_s = 2.0;
  explicit Search(const World& world) : map(known_map(world, 0.15)) {
    reserve(lost);
    begin_search(lost, testing::belief_of({0.0, 0.2, 1.2}, {0.0, 1.2, 0.0}, 0.0), step(), params);
  }
  SearchStep step() const { return {now_s, vehicle, map, vehicle.position_enu_m, Vec3::Zero()}; }
  void search(double time_s) {
    for (const double end_s = now_s + time_s; now_s < end_s; now_s += 0.033) {
      believe(lost, step(), params);
      choose_viewpoint(lost, step(), params);
    }
  }
};

TEST(LostPerson, FliesToWhereTheyMayComeOutAndStaysWhereItCanFly) {
  Search s(testing::wall_with_doors({0.0, 6.0}));
  s.search(4.0);
  ASSERT_GE(s.lost.viewpoint.worth, 0.0);
  EXPECT_LT(s.lost.viewpoint.at_m.y(), -0.3) << "not through the narrow door";
  ASSERT_FALSE(s.lost.way.empty());
  for (const Vec2& p : s.lost.way)
    EXPECT_GE(s.map.unfree_distance_m({p.x(), p.y(), 1.3}), s.params.path_clearance_m() - 1e-9);
  EXPECT_LT((s.lost.way.back() - s.lost.viewpoint.at_m).norm(), 0.2);
}

TEST(LostPerson, IsFastOnlyWhereNobodyCanBeAhead) {
  Search s(testing::wall_with_doors({0.0}));
  s.lost.free_m = 1.0;
  EXPECT_EQ(search_speed_m_s(s.lost, s.params), s.params.view.search_speed_m_s);
  s.lost.free_m = 5.5;
  EXPECT_GT(search_speed_m_s(s.lost, s.params), 2.0);
  s.lost.free_m = 100.0;
  EXPECT_EQ(search_speed_m_s(s.lost, s.params), s.params.limits.speed_max_m_s);
}

TEST(LostPerson, BeliefNearTheVehicleIsKeptClearOf) {
  Search s(testing::empty_world(12.0));
  s.search(0.5);
  BodyCourses courses;
  add_near_belief(s.lost, s.now_s, s.params.body, courses);
  for (const BodyCourse& course : courses.all()) {
    EXPECT_LT(distance_xy(course.body.position_enu_m, s.vehicle.position_enu_m), 3.1);
    EXPECT_GE(course.probability, s.params.body.course_probability_min);
  }
  s.vehicle.position_enu_m = {0.0, 1.0, 1.3};  // amid the belief, with its back to it
  s.vehicle.q_world_body = Quat(Eigen::AngleAxisd(-0.5 * kPi, Vec3::UnitZ()));
  s.search(0.2);
  courses.count = 0;
  add_near_belief(s.lost, s.now_s, s.params.body, courses);
  EXPECT_GT(courses.count, 0);
}

TEST(LostPerson, TheSameCallsGiveTheSameSearch) {
  const World world = testing::wall_with_doors({0.0, 6.0});
  Search a(world), b(world);
  a.search(2.0);
  b.search(2.0);
  EXPECT_EQ(a.lost.viewpoint.at_m, b.lost.viewpoint.at_m);
  EXPECT_EQ(a.lost.likeliest_m, b.lost.likeliest_m);
  EXPECT_EQ(a.lost.gaze_rad, b.lost.gaze_rad);
}

TEST(LostPerson, AllocatesNothingWhileItSearches) {
  Search s(testing::wall_with_doors({0.0, 6.0}));
  const long before = allocation_count();
  s.search(2.0);
  begin_search(s.lost, testing::belief_of({0.0, 0.2, 1.2}, {0.0, 1.2, 0.0}, 0.0, 0.2), s.step(),
               s.params);
  EXPECT_LE(allocation_count() - before, 8) << "the belief of this test alone";
}

}  // namespace
}  // namespace foretrack
