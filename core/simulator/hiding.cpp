// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/hiding.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/common/random.hpp"
#include "core/simulator/scenario.hpp"

namespace foretrack {
namespace {

constexpr double kThickness_m = 0.3;  // of walls
constexpr double kWallHeight_m = 4.0;
constexpr double kStreet_m = 1.5;  // of the walk, from the wall
constexpr double kAfter_s = 11.0;  // walked on after they have come back
constexpr double kLongest_s = 20.0, kShortest_s = 2.0;

struct Door {
  double x_m = 0.0;
  double width_m = 0.64;
};

// A street along x below y = 0; what hides is above.
struct HidingStage {
  Scenario& scenario;
  Random random;
  double speed_m_s = 1.0;
  std::vector<Vec2> inside;  // the way while they are out of reach, from door to door

  double between(double low, double high) { return random.uniform(low, high); }
  double narrow_m() { return between(0.62, 0.66); }
  double wide_m() { return between(1.3, 1.7); }
  void box(double x0, double y0, double x1, double y1) {
    if (x1 - x0 > 0.02 && y1 - y0 > 0.02)
      scenario.world.boxes.push_back({{x0, y0, 0.0}, {x1, y1, kWallHeight_m}});
  }
  // A wall along x with doors; the doors by x.
  void wall_along_x(double x0, double x1, double y, std::vector<Door> doors) {
    std::ranges::sort(doors, {}, &Door::x_m);
    for (const Door& door : doors) {
      box(x0, y, door.x_m - 0.5 * door.width_m, y + kThickness_m);
      x0 = door.x_m + 0.5 * door.width_m;
    }
    box(x0, y, x1, y + kThickness_m);
  }
  void wall_along_y(double x, double y0, double y1, const Door* door) {
    if (door == nullptr) return box(x, y0, x + kThickness_m, y1);
    box(x, y0, x + kThickness_m, door->x_m - 0.5 * door->width_m);
    box(x, door->x_m + 0.5 * door->width_m, x + kThickness_m, y1);
  }
  double inside_m() const {
    double length_m = 0.0;
    for (std::size_t i = 1; i < inside.size(); ++i) length_m += (inside[i] - inside[i - 1]).norm();
    return length_m;
  }
};

void set_bounds(Scenario& s, double x0, double x1, double y0, double y1) {
  s.world.min_m = {x0, y0, 0.0};
  s.world.max_m = {x1, y1, 5.0};
}

// So fast that the way inside takes neither too long nor no time at all.
void choose_speed(HidingStage& stage) {
  const double least_m_s = std::clamp(stage.inside_m() / (kLongest_s - 3.0), 0.5, 1.5);
  const double most_m_s = std::clamp(stage.inside_m() / kShortest_s, least_m_s, 1.5);
  stage.speed_m_s = stage.scenario.target.speed_m_s = stage.between(least_m_s, most_m_s);
}

// They come along the street from the left, go in, and on along the street or another one.
void walk(HidingStage& stage, const Vec2& out, double street_y, bool to_right) {
  Scenario& s = stage.scenario;
  choose_speed(stage);
  const double approach_m = 2.5 + 2.5 * stage.speed_m_s, after_m = kAfter_s * stage.speed_m_s;
  const Vec2 in = stage.inside.front();
  std::vector<Vec2>& route = s.target.route_m;
  route = {{in.x() - approach_m, -kStreet_m}, {in.x(), -kStreet_m}};
  route.insert(route.end(), stage.inside.begin(), stage.inside.end());
  route.emplace_back(out.x(), street_y);
  route.emplace_back(out.x() + (to_right ? after_m : -after_m), street_y);
  const double walked_s = stage.inside_m() / stage.speed_m_s;
  const double wanted_s =
      stage.random.chance(0.5) ? stage.between(kShortest_s, kLongest_s) : walked_s;
  const double start_s = s.target.person.start_s;
  const double in_s = start_s + (approach_m + kStreet_m) / stage.speed_m_s + 0.6;
  double stood_s = 0.0;
  if (wanted_s > walked_s + 0.5) {
    stood_s = wanted_s - walked_s;
    s.target.person.stops = {{in_s + 0.5 * walked_s, stood_s}};
  }
  s.duration_s = std::ceil(in_s + walked_s + stood_s + kStreet_m / stage.speed_m_s + kAfter_s);
}

void stage_wall(HidingStage& stage) {
  const double inside_y = stage.between(1.2, 3.0);
  const bool same = stage.random.chance(0.25);
  const double apart_m = stage.between(3.0, 14.0);
  std::vector<Door> doors = {{0.0, stage.narrow_m()}, {apart_m, stage.narrow_m()}};
  if (stage.random.chance(0.5)) doors.push_back({-stage.between(3.0, 6.0), stage.narrow_m()});
  if (stage.random.chance(0.5))
    doors.push_back({apart_m + stage.between(3.0, 6.0), stage.narrow_m()});
  set_bounds(stage.scenario, -22.0, apart_m + 22.0, -8.0, stage.between(5.0, 9.0));
  stage.wall_along_x(-22.0, apart_m + 22.0, 0.0, doors);
  const double out_x = same ? 0.0 : apart_m;
  const Vec2 turn(same ? stage.between(0.6, 4.0) : out_x, inside_y);
  stage.inside = {{0.0, 0.0}, {0.0, inside_y}, turn};
  if (same) stage.inside.emplace_back(0.0, inside_y);
  stage.inside.emplace_back(out_x, 0.0);
  walk(stage, {out_x, 0.0}, -kStreet_m, stage.random.chance(0.5));
}

void stage_rooms(HidingStage& stage) {
  constexpr int kRooms = 5, kFirst = 2;  // they go into the middle one
  const double depth_m = stage.between(4.0, 6.0);
  std::array<double, kRooms + 1> edge_m{};
  edge_m[kFirst] = -stage.between(1.5, 3.5);
  for (int i = kFirst; i < kRooms; ++i) edge_m[i + 1] = edge_m[i] + stage.between(4.0, 6.0);
  for (int i = kFirst; i > 0; --i) edge_m[i - 1] = edge_m[i] - stage.between(4.0, 6.0);
  edge_m[kFirst + 1] = std::max(edge_m[kFirst + 1], 1.5);
  const double end_m = edge_m[kRooms] + kThickness_m;
  set_bounds(stage.scenario, edge_m[0] - 10.0, end_m + 10.0, -8.0, depth_m + 1.0);
  const bool next_room = stage.random.chance(0.6);
  std::vector<Door> doors;
  for (int i = 0; i < kRooms; ++i) {
    const double x = i == kFirst ? 0.0 : 0.5 * (edge_m[i] + edge_m[i + 1] + kThickness_m);
    const bool wide = i != kFirst && stage.random.chance(0.5);
    doors.push_back({x, wide ? stage.wide_m() : stage.narrow_m()});
  }
  stage.wall_along_x(edge_m[0], end_m, 0.0, doors);
  stage.box(edge_m[0], depth_m, end_m, depth_m + kThickness_m);
  const Door between_rooms{stage.between(1.2, depth_m - 0.8), stage.narrow_m()};
  for (int i = 0; i <= kRooms; ++i)
    stage.wall_along_y(edge_m[i], kThickness_m, depth_m,
                       next_room && i == kFirst + 1 ? &between_rooms : nullptr);
  const double y = between_rooms.x_m;
  const double out_x = next_room ? doors[kFirst + 1].x_m : 0.0;
  stage.inside = {{0.0, 0.0}, {0.0, y}};
  if (next_room)
    stage.inside.emplace_back(out_x, y);
  else
    stage.inside.insert(stage.inside.end(), {{0.7, y}, {0.0, y}});
  stage.inside.emplace_back(out_x, 0.0);
  walk(stage, {out_x, 0.0}, -kStreet_m, stage.random.chance(0.5));
}

void stage_street(HidingStage& stage) {
  const double depth_m = stage.between(4.0, 10.0), left_m = stage.between(4.0, 9.0),
               right_m = stage.between(4.0, 9.0);
  const double half_m = 0.5 * stage.narrow_m();
  const bool court = stage.random.chance(0.4);
  set_bounds(stage.scenario, -left_m - 24.0, right_m + 24.0, -7.0, depth_m + 7.0);
  if (court) {  // of 3 m, in the middle of the block; a way in, no way through
    const double y0 = stage.between(1.5, depth_m - 2.2), y1 = std::min(y0 + 3.0, depth_m - 0.5);
    stage.box(-left_m, 0.0, -half_m, y0);
    stage.box(half_m, 0.0, right_m, y0);
    stage.box(-left_m, y0, -1.5, y1);
    stage.box(1.5, y0, right_m, y1);
    stage.box(-left_m, y1, right_m, depth_m);
    stage.inside = {{0.0, 0.0},
                    {0.0, 0.5 * (y0 + y1)},
                    {0.7, 0.5 * (y0 + y1)},
                    {0.0, 0.5 * (y0 + y1)},
                    {0.0, 0.0}};
    return walk(stage, {0.0, 0.0}, -kStreet_m, stage.random.chance(0.5));
  }
  stage.box(-left_m, 0.0, -half_m, depth_m);
  stage.box(half_m, 0.0, right_m, depth_m);
  stage.inside = {{0.0, 0.0}, {0.0, depth_m}};
  walk(stage, {0.0, depth_m}, depth_m + kStreet_m, stage.random.chance(0.5));
}

}  // namespace

void stage_hiding(HidingKind kind, Scenario& scenario) {
  HidingStage stage{scenario, Random(seed_of(scenario, 7)), 1.0, {}};
  scenario.world = World{};
  switch (kind) {
    case HidingKind::kWall:
      return stage_wall(stage);
    case HidingKind::kRooms:
      return stage_rooms(stage);
    case HidingKind::kStreet:
      return stage_street(stage);
  }
}

}  // namespace foretrack
