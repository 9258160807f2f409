// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/encounter.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/common/random.hpp"
#include "core/simulator/scenario.hpp"

namespace foretrack {
namespace {

constexpr double kFollowed_m = 2.0;   // the vehicle's usual distance
constexpr double kFirst_s = 4.5;      // the first meeting: by then it follows
constexpr double kWall_m = 0.3;       // thickness
constexpr double kWayOn_m = 8.0;      // that walks go on after a meeting
constexpr double kShoulder_m = 0.35;  // from a wall to a person's middle
constexpr double kPass_m = 0.55;      // between the middles of two who pass each other
constexpr double kMargin_m = 3.0;     // of the bounds around all walks
constexpr double kApproach_s = 3.5;   // they set off this long before they meet,
constexpr double kApproach_m = 4.0;   // and this far away, if there is time for it

// The followed person walks along x from the origin; a corridor is around the x axis.
struct Stage {
  Scenario& scenario;
  Random random;
  EncounterPlace place = EncounterPlace::kOpen;
  double speed_m_s = 0.0;     // of those who come near
  double followed_m_s = 0.0;  // of the followed person
  double half_width_m = 0.0;  // of the corridor
  double height_m = 4.0;      // of the walls

  double between(double low, double high) { return random.uniform(low, high); }
  double start_s() const { return scenario.target.person.start_s; }
  // Where the followed person, who walks straight on, will be.
  double followed_x_m(double at_s) const {
    const double setting_off_s = 0.5 * followed_m_s / scenario.target.person.acceleration_m_s2;
    return followed_m_s * std::max(0.0, at_s - start_s() - setting_off_s);
  }
  double side_m() { return random.chance(0.5) ? 1.0 : -1.0; }
  bool walled() const { return place != EncounterPlace::kOpen; }
  // The times at which somebody is met.
  std::vector<double> meetings() {
    std::vector<double> times;
    for (double t = kFirst_s; t < scenario.duration_s - 1.5; t += between(2.2, 3.0))
      times.push_back(t);
    return times;
  }
  void add_box(double x0, double y0, double x1, double y1) {
    if (x1 - x0 > 0.05 && y1 - y0 > 0.05)
      scenario.world.boxes.push_back({{x0, y0, 0.0}, {x1, y1, height_m}});
  }
  // Straight through `at`, to be there at a time, and kWayOn_m further.
  void send(const Vec2& at, const Vec2& direction, double at_s) {
    BystanderSpec b;
    b.speed_m_s = speed_m_s;
    const double walk_s = std::min(at_s - 0.1, std::max(kApproach_s, kApproach_m / speed_m_s));
    const double ramp_m = 0.5 * speed_m_s * speed_m_s / b.walk.acceleration_m_s2;
    b.route_m = {at - (speed_m_s * walk_s) * direction, at + kWayOn_m * direction};
    b.walk.start_s = std::max(0.0, at_s - walk_s - ramp_m / speed_m_s);
    b.walk.height_m = random.chance(0.15) ? between(1.0, 1.3) : between(1.5, 1.9);
    scenario.bystanders.push_back(std::move(b));
  }
  // Beside the followed person: people do not walk through each other.
  double lateral_m() {
    const double reach_m = walled() ? half_width_m - kShoulder_m : 1.2;
    return side_m() * between(std::min(kPass_m, reach_m), reach_m);
  }
};

EncounterPlace draw_place(EncounterKind kind, Random& random) {
  using enum EncounterPlace;
  static constexpr std::array along = {kOpen, kCorridor, kDeadEnd, kJunction};
  static constexpr std::array across = {kOpen, kJunction};
  static constexpr std::array ways = {kOpen, kCorridor, kJunction};
  const auto draw = [&](std::span<const EncounterPlace> places) {
    return places[random.integer(0, static_cast<int>(places.size()) - 1)];
  };
  switch (kind) {
    case EncounterKind::kHeadOn:
    case EncounterKind::kTurnBack:
      return draw(along);
    case EncounterKind::kCrossBefore:
    case EncounterKind::kCrossBehind:
    case EncounterKind::kTowards:
      return draw(across);
    case EncounterKind::kStop:
    case EncounterKind::kGroup:
      break;
  }
  return draw(ways);
}

// To and fro along x; each leg takes as long as it is to the next meeting.
void walk_to_and_fro(Stage& s, double from_x_m, double first_leg_m) {
  auto& route = s.scenario.target.route_m;
  route = {{from_x_m, 0.0}, {from_x_m + first_leg_m, 0.0}};
  double way = first_leg_m > 0.0 ? -1.0 : 1.0;
  for (double t = kFirst_s; t < s.scenario.duration_s; t += 3.0) {
    route.push_back({route.back().x() + way * s.speed_m_s * s.between(2.5, 3.5), 0.0});
    way = -way;
  }
}

// The followed person walks at the vehicle, which hovers before them.
void walk_at_vehicle(Stage& s) {
  const double ahead_m = s.between(2.5, 4.0);
  s.scenario.vehicle_enu_m = Vec3(ahead_m, s.between(-0.2, 0.2), 1.5);
  s.scenario.vehicle_yaw_rad = kPi;
  walk_to_and_fro(s, 0.0, std::max(ahead_m + s.between(2.0, 4.0), 3.5 * s.speed_m_s));
}

void stage_head_on(Stage& s) {
  if (s.place == EncounterPlace::kDeadEnd || s.random.chance(0.4)) {
    s.followed_m_s = s.speed_m_s;
    return walk_at_vehicle(s);
  }
  for (const double t : s.meetings())
    s.send({s.followed_x_m(t) - kFollowed_m, s.lateral_m()}, -Vec2::UnitX(), t);
}

void stage_turn_back(Stage& s) {
  s.followed_m_s = s.speed_m_s;
  walk_to_and_fro(s, 0.0, s.speed_m_s * s.between(2.5, 3.5));
}

// Stands for a while at each meeting; or a companion does, who walks beside.
void stage_stop(Stage& s) {
  s.followed_m_s = s.speed_m_s;
  std::vector<StandStill> stops;
  for (const double t : s.meetings()) stops.push_back({t, s.between(0.8, 1.6)});
  if (s.random.chance(0.5)) {
    s.scenario.target.person.stops = stops;
    return;
  }
  BystanderSpec companion;
  companion.speed_m_s = s.speed_m_s;
  const double lag_m = s.between(0.2, 1.2), aside_m = s.walled() ? 0.5 * s.half_width_m : 0.6;
  const Vec2 start(-lag_m, s.side_m() * aside_m);
  companion.route_m = {start, start + (s.speed_m_s * s.scenario.duration_s) * Vec2::UnitX()};
  companion.walk.start_s = s.start_s();
  companion.walk.stops = {{stops.front().at_s, s.scenario.duration_s}};
  s.scenario.bystanders.push_back(companion);
}

// Across the way where the vehicle, shifted by ahead_m along it, will be.
void send_across(Stage& s, double ahead_m, double at_s) {
  const double x = s.followed_x_m(at_s) - kFollowed_m + ahead_m;
  const double angle = s.walled() ? 0.5 * kPi : s.between(rad(50.0), rad(130.0));
  const Vec2 direction = s.side_m() * direction_of(angle);
  s.send({x, 0.0}, direction, at_s);
}

void stage_cross_before(Stage& s) {
  for (const double t : s.meetings()) send_across(s, s.between(0.5, 1.4), t);
}

void stage_cross_behind(Stage& s) {
  for (const double t : s.meetings()) send_across(s, -s.between(0.3, 1.4), t);
}

void stage_towards(Stage& s) {
  for (const double t : s.meetings()) {
    if (s.walled()) {
      send_across(s, 0.0, t);
      continue;
    }
    // From anywhere but straight behind, where its camera does not look, and straight ahead, where
    // the followed person is.
    const double beside_rad = std::asin(1.3 * kPass_m / kFollowed_m);
    const double from = s.side_m() * s.between(beside_rad, rad(120.0));
    s.send({s.followed_x_m(t) - kFollowed_m, 0.0}, -direction_of(from), t);
  }
}

void stage_group(Stage& s) {
  const double t = kFirst_s + s.between(0.0, 1.0);
  const Vec2 at(s.followed_x_m(t) - kFollowed_m, 0.0);
  const bool across = s.place != EncounterPlace::kCorridor && s.random.chance(0.5);
  const double from =
      s.place == EncounterPlace::kOpen ? s.between(rad(50.0), rad(110.0)) : 0.5 * kPi;
  const Vec2 direction = across ? Vec2(s.side_m() * direction_of(from)) : Vec2(-Vec2::UnitX());
  const Vec2 left(-direction.y(), direction.x());
  const int count = s.random.integer(2, 8);
  for (int row = 0, placed = 0; placed < count; ++row) {
    const double side_m = s.between(0.5, 0.8);  // two abreast, the rows 0.7 m apart
    const double reach_m = s.walled() ? std::min(side_m, s.half_width_m - kShoulder_m) : side_m;
    for (const double y : {reach_m, -reach_m}) {
      if (placed++ == count) return;
      s.send(at + y * left - (0.7 * row + s.between(-0.15, 0.15)) * direction, direction, t);
    }
  }
}

// Side streets where bystanders cross, as wide as the corridor itself may be.
std::vector<Vec2> side_streets(Stage& s) {
  std::vector<Vec2> streets;  // x from and to
  const auto add = [&](double x) {
    const double half_m = 0.5 * s.between(1.6, 3.5);
    streets.push_back({x - half_m, x + half_m});
  };
  for (const BystanderSpec& b : s.scenario.bystanders) {
    const Vec2& a = b.route_m.front();
    const Vec2 way = b.route_m.back() - a;
    if (std::abs(way.y()) > 1e-3) add(a.x() - a.y() / way.y() * way.x());
  }
  if (streets.empty()) add(s.followed_m_s * s.between(1.5, 5.0));
  std::sort(streets.begin(), streets.end(),
            [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); });
  return streets;
}

void build_walls(Stage& s, const Vec2& low, const Vec2& high) {
  if (!s.walled()) return;
  const double w = s.half_width_m;
  std::vector<Vec2> gaps;
  if (s.place == EncounterPlace::kJunction) gaps = side_streets(s);
  double x = low.x();
  gaps.push_back({high.x(), high.x()});
  for (const Vec2& gap : gaps) {
    // In a junction what lies between the streets is solid: nobody is seen before the corner.
    const double depth_m = s.place == EncounterPlace::kJunction ? kMargin_m : kWall_m;
    s.add_box(x, w, gap.x(), w + depth_m);
    s.add_box(x, -w - depth_m, gap.x(), -w);
    x = std::max(x, gap.y());
  }
}

// The end of the corridor where the followed person turns round.
void close_end(Stage& s) {
  if (s.place != EncounterPlace::kDeadEnd) return;
  double end_x = 0.0;
  for (const Vec2& p : s.scenario.target.route_m) end_x = std::max(end_x, p.x());
  end_x += s.between(0.4, 1.0);
  s.add_box(end_x, -s.half_width_m - kWall_m, end_x + kWall_m, s.half_width_m + kWall_m);
}

void set_bounds(Stage& s) {
  Eigen::AlignedBox2d box(Vec2(-5.0, -4.0), Vec2(5.0, 4.0));
  for (const Vec2& p : s.scenario.target.route_m) box.extend(p);
  for (const BystanderSpec& b : s.scenario.bystanders)
    for (const Vec2& p : b.route_m) box.extend(p);
  const Vec2 low = box.min() - Vec2::Constant(kMargin_m);
  const Vec2 high = box.max() + Vec2::Constant(kMargin_m);
  s.scenario.world.min_m = {low.x(), low.y(), 0.0};
  s.scenario.world.max_m = {high.x(), high.y(), 6.0};
  build_walls(s, low, high);
  close_end(s);
}

}  // namespace

void stage_encounter(EncounterKind kind, Scenario& scenario) {
  Stage s{.scenario = scenario,
          .random = Random(scenario.seed * 64 + static_cast<std::uint64_t>(kind))};
  s.place = draw_place(kind, s.random);
  s.speed_m_s = scenario.target.speed_m_s;
  s.followed_m_s = std::min(s.speed_m_s, s.between(0.8, 1.6));
  s.half_width_m = 0.5 * s.between(1.6, 4.0);
  s.height_m = s.between(3.5, 4.5);
  switch (kind) {
    case EncounterKind::kHeadOn:
      stage_head_on(s);
      break;
    case EncounterKind::kTurnBack:
      stage_turn_back(s);
      break;
    case EncounterKind::kStop:
      stage_stop(s);
      break;
    case EncounterKind::kCrossBefore:
      stage_cross_before(s);
      break;
    case EncounterKind::kCrossBehind:
      stage_cross_behind(s);
      break;
    case EncounterKind::kTowards:
      stage_towards(s);
      break;
    case EncounterKind::kGroup:
      stage_group(s);
      break;
  }
  scenario.encounter = Encounter{kind, s.place};
  scenario.target.speed_m_s = s.followed_m_s;
  if (scenario.target.route_m.empty())
    scenario.target.route_m = {{0.0, 0.0}, {s.followed_m_s * scenario.duration_s, 0.0}};
  set_bounds(s);
}

}  // namespace foretrack
