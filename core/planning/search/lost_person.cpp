// SPDX-License-Identifier: Apache-2.0
#include "core/planning/search/lost_person.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack {
namespace {

constexpr double kTick_s = 0.1;
constexpr double kViewMargin_rad = 0.1;  // at each side of the image: not all of a person is in it
constexpr double kReach_m = 24.0;        // of the vehicle, by way
constexpr double kWayShare = 0.85;       // of a way in steps along x and y, when it is straightened
constexpr int kReachExpansions = 20000;  // in one step
constexpr int kViewpointsJudged = 36, kViewpointsAStep = 6;
constexpr double kBetterViewpoint = 1.25;  // by which another viewpoint must be
constexpr double kNearFactor = 0.3;  // of a viewpoint's worth, where the person can be beside it
constexpr double kEscape_m = 0.8;    // on which the way out of a narrow place may be narrow
constexpr int kGazes = LostPerson::kGazes;
constexpr double kGazeAhead_s = 0.5;
constexpr double kAlongWay = 0.06;    // belief that the look along the way is worth
constexpr double kAtViewpoint = 0.3;  // share of a viewpoint's worth, for its own direction
constexpr double kGazeBetter = 1.2, kGazeLess = 0.003;
constexpr double kGlance_s = 0.008;     // belief that a second of not looking there is worth,
constexpr double kGlanceReach_m = 4.0;  // where the person can be so near
constexpr double kTravelHalf_rad = rad(40.0);
constexpr double kNearHorizon_s = 1.0;  // that places near the vehicle count ahead
constexpr double kWayAhead_m = 1.0, kThere_m = 0.4;

double half_view_rad(const PlanningParams& params) {
  return 0.5 * params.view.fov_horizontal_rad - kViewMargin_rad;
}

// One layer of the map, by the ground's cells.
struct FlightLayer {
  FlightLayer(const GridMap& map_in, const SearchGround& ground, double level_m, double required)
      : map(map_in), required_cm(static_cast<int>(std::ceil(100.0 * required - 1e-6))) {
    const Vec2 offset = (ground.corner_m - map.origin_enu_m.head<2>()) / map.resolution_m;
    dx = static_cast<int>(std::lround(offset.x()));
    dy = static_cast<int>(std::lround(offset.y()));
    z = static_cast<int>(std::floor((level_m - map.origin_enu_m.z()) / map.resolution_m));
  }
  int clearance_cm(int cell) const {
    const int x = cell % kGroundSide, y = cell / kGroundSide;
    const Eigen::Vector3i i(x + dx, y + dy, z);
    const bool border = x == 0 || y == 0 || x == kGroundSide - 1 || y == kGroundSide - 1;
    return border || !map.contains(i) ? 0 : map.unfree_distance_cm[map.offset_of(i)];
  }
  const GridMap& map;
  int required_cm, dx, dy, z;
};

double flight_level_m(const LostPerson& lost, const PlanningParams& params) {
  return lost.torso_m + params.place.height_above_target_m;
}

void grow_reach(LostPerson& lost, const SearchStep& step, const PlanningParams& params) {
  const SearchGround& ground = lost.ground;
  const FlightLayer layer(step.map, ground, flight_level_m(lost, params),
                          params.path_clearance_m());
  if (lost.reach.goal < 0) {
    const int cell = ground.cell_of(step.from_enu_m.head<2>());
    if (cell < kGroundSide || cell >= kGroundSide * (kGroundSide - 1)) return;
    begin_field(lost.reach, lost.reached, cell);
    lost.reach_clearance_m = layer.clearance_cm(cell);
  }
  const Vec2 root = ground.center_of(lost.reach.goal);
  const int least_cm = std::min<int>(layer.required_cm, static_cast<int>(lost.reach_clearance_m));
  const auto may_fly = [&](int cell) {
    const int cm = layer.clearance_cm(cell);
    return cm >= layer.required_cm ||
           (cm > 0 && cm >= least_cm && (ground.center_of(cell) - root).norm() < kEscape_m);
  };
  grow_field(lost.reach, lost.reached, kReachExpansions,
             static_cast<int>(kReach_m / ground.resolution_m), may_fly);
}

void gather_open_cells(LostPerson& lost) {
  PersonCloud& cloud = lost.cloud;
  const int count = static_cast<int>(lost.reached.cells.size());
  for (std::int32_t& cell : cloud.open_cells)
    cell = lost.reached.cells[cloud.random.integer(0, count - 1)];
  cloud.open_count = static_cast<int>(cloud.open_cells.size());
}

void judge(LostPerson& lost, int cell, bool present, const PlanningParams& params) {
  if (lost.reach.steps[cell] == DistanceField::kNever) return;
  const SearchGround& ground = lost.ground;
  const double way_m = kWayShare * ground.resolution_m * lost.reach.steps[cell];
  const double speed_m_s = 0.5 * (params.view.search_speed_m_s + params.limits.speed_max_m_s);
  const Vec2 at = ground.center_of(cell);
  Viewpoint view = judge_viewpoint(lost.future, ground, lost.reach, at, way_m / speed_m_s,
                                   2.0 * half_view_rad(params), params.search);
  if (may_be_near(ground, at, params.place.distance_low_m)) view.worth *= kNearFactor;
  if (present) view.worth *= kBetterViewpoint;
  if (view.worth > lost.best.worth) lost.best = view;
}

// Back from the viewpoint to where the vehicle was.
void take_way(LostPerson& lost) {
  lost.way.clear();
  int cell = lost.ground.cell_of(lost.best.at_m);
  for (int i = 0; i < static_cast<int>(lost.way.capacity()); ++i) {
    lost.way.push_back(lost.ground.center_of(cell));
    const int next = downhill(lost.reach, cell);
    if (next == cell) break;
    cell = next;
  }
  std::ranges::reverse(lost.way);
  lost.viewpoint = lost.best;
}

bool is_there(const LostPerson& lost, const Vec2& from) {
  return lost.viewpoint.worth < 0.0 || (lost.viewpoint.at_m - from).norm() < kThere_m;
}

// Belief in sight of a place, by direction.
std::array<double, kGazes> belief_around(const LostPerson& lost, const Vec2& from,
                                         const SearchParams& params) {
  std::array<double, kGazes> bins{};
  for (const Walker& w : lost.cloud.walkers) {
    const double ahead_s = w.stands_s > 0.0 ? 0.0 : kGazeAhead_s;
    const Vec2 at = w.at_m + ahead_s * w.speed_m_s * w.heading;
    const Vec2 span = at - from;
    if (span.norm() > params.search_sight_m || !is_in_sight(lost.ground, from, at)) continue;
    const int bin = static_cast<int>((yaw_of(span) + kPi) / (2.0 * kPi) * kGazes);
    bins[std::clamp(bin, 0, kGazes - 1)] += w.weight;
  }
  return bins;
}

void add_gaze(std::array<double, kGazes>& bins, double yaw_rad, double weight) {
  const int bin = static_cast<int>((wrap_angle(yaw_rad) + kPi) / (2.0 * kPi) * kGazes);
  bins[std::clamp(bin, 0, kGazes - 1)] += weight;
}

double gaze_yaw_rad(int i) {
  return (i + 0.5) * 2.0 * kPi / kGazes - kPi;
}

// Whoever walks up to the vehicle from a side at which it never looks would run into it.
void add_glances(LostPerson& lost, const Vec2& from, double yaw_rad, double half_rad, double dt_s,
                 std::array<double, kGazes>& bins) {
  for (int i = 0; i < kGazes; ++i) {
    const bool looks = std::abs(wrap_angle(gaze_yaw_rad(i) - yaw_rad)) < half_rad;
    lost.unseen_s[i] = looks ? 0.0 : lost.unseen_s[i] + dt_s;
    const double free_m =
        free_ahead_m(lost.ground, from, gaze_yaw_rad(i), kPi / kGazes, kGlanceReach_m);
    if (free_m < kGlanceReach_m) bins[i] += kGlance_s * lost.unseen_s[i];
  }
}

void choose_gaze(LostPerson& lost, const Vec2& from, double yaw_rad, double dt_s,
                 const PlanningParams& params) {
  std::array<double, kGazes> bins = belief_around(lost, from, params.search);
  add_glances(lost, from, yaw_rad, half_view_rad(params), dt_s, bins);
  if (is_there(lost, from))
    add_gaze(bins,
             lost.viewpoint.worth < 0.0 ? yaw_of(Vec2(lost.likeliest_m - from))
                                        : lost.viewpoint.gaze_rad,
             kAlongWay + kAtViewpoint * std::max(lost.viewpoint.worth, 0.0));
  else
    add_gaze(bins, yaw_of(Vec2(ahead_on_way_m(lost, from) - from)), kAlongWay);
  const double half_rad = half_view_rad(params);
  const auto seen = [&](double gaze_rad) {
    double sum = 0.0;
    for (int i = 0; i < kGazes; ++i) {
      const double off_rad = std::abs(wrap_angle(gaze_yaw_rad(i) - gaze_rad));
      // Rather in the middle of the image.
      if (off_rad < half_rad) sum += bins[i] * (1.0 - 0.3 * off_rad / half_rad);
    }
    return sum;
  };
  double best = kGazeBetter * seen(lost.gaze_rad) + kGazeLess, gaze_rad = lost.gaze_rad;
  for (int i = 0; i < kGazes; ++i) {
    if (const double sum = seen(gaze_yaw_rad(i)); sum > best)
      best = sum, gaze_rad = gaze_yaw_rad(i);
  }
  lost.gaze_rad = gaze_rad;
}

// How far people could walk to the vehicle from, within search_near_m.
void gather_near(LostPerson& lost, const Vec2& from, const PlanningParams& params) {
  const SearchGround& ground = lost.ground;
  lost.near_count = 0;
  const int cell = ground.cell_of(from);
  if (cell < kGroundSide || cell >= kGroundSide * (kGroundSide - 1)) return;
  begin_field(lost.steps_away, lost.steps_queue, cell);
  const int most = static_cast<int>(params.search.search_near_m / ground.resolution_m);
  grow_field(lost.steps_away, lost.steps_queue, kGroundSide * kGroundSide, most,
             [&](int c) { return (ground.what[c] & SearchGround::kWall) == 0; });
  for (const Walker& w : lost.cloud.walkers) {
    const int at = ground.cell_of(w.at_m);
    if (at < 0 || lost.steps_away.steps[at] == DistanceField::kNever) continue;
    const Vec2 velocity = w.stands_s > 0.0 ? Vec2(Vec2::Zero()) : Vec2(w.speed_m_s * w.heading);
    int i = 0;
    while (i < lost.near_count && (lost.near[i].at_m - w.at_m).norm() > 0.7) ++i;
    if (i == LostPerson::kNear) continue;
    if (i == lost.near_count) lost.near[lost.near_count++] = {w.at_m, velocity, 0.0};
    NearBelief& near = lost.near[i];
    const double share = w.weight / std::max(near.probability + w.weight, 1e-12);
    near.at_m += share * (w.at_m - near.at_m);
    near.velocity_m_s += share * (velocity - near.velocity_m_s);
    near.probability += w.weight;
  }
}

}  // namespace

void reserve(LostPerson& lost) {
  reserve(lost.cloud);
  reserve(lost.ground);
  reserve(lost.reach);
  reserve(lost.reached);
  reserve(lost.steps_away);
  reserve(lost.steps_queue);
  lost.way.reserve(512);
}

void begin_search(LostPerson& lost, const TargetBelief& belief, const SearchStep& step,
                  const PlanningParams& params) {
  const Vec3 seen = position_on(belief.paths[0], 0.0);
  lost.active = true;
  lost.since_s = belief.stamp_s;
  lost.ticked_s = step.now_s;
  lost.torso_m = seen.z();
  lost.viewpoint = lost.best = Viewpoint{};
  lost.way.clear();
  lost.judged = -1;
  lost.reach.goal = -1;
  lost.near_count = 0;
  lost.free_m = 0.0;
  lost.unseen_s.fill(0.0);
  lost.gaze_rad = step.vehicle.yaw_rad();
  begin_ground(lost.ground, step.map, seen);
  spread(lost.ground, params.body.body_speed_m_s * std::max(step.now_s - belief.stamp_s, 0.0));
  begin_cloud(lost.cloud, lost.ground, belief, step.now_s, params.search);
  lost.likeliest_m = likeliest_place_m(lost.cloud);
}

void believe(LostPerson& lost, const SearchStep& step, const PlanningParams& params) {
  plan_errands(lost.cloud, lost.ground);
  const double dt_s = step.now_s - lost.ticked_s;
  if (dt_s < kTick_s - 1e-6) return;
  lost.ticked_s = step.now_s;
  const double person_m_s = std::max(params.body.body_speed_m_s, lost.cloud.speed_m_s);
  const Vec2 eye = step.vehicle.position_enu_m.head<2>();
  const double yaw_rad = step.vehicle.yaw_rad(), half_rad = half_view_rad(params);
  read_map(lost.ground, step.map);
  spread(lost.ground, person_m_s * dt_s);
  walk_on(lost.cloud, lost.ground, dt_s);
  look_in_vain(lost.ground, eye, yaw_rad, half_rad, params.search.search_sight_m);
  look_in_vain(lost.cloud, lost.ground, eye, yaw_rad, half_rad, params.search);
  lost.likeliest_m = likeliest_place_m(lost.cloud);

  const Vec2 from = step.from_enu_m.head<2>();
  choose_gaze(lost, from + kGazeAhead_s * step.velocity_m_s.head<2>(), yaw_rad, dt_s, params);
  const Vec2 velocity = step.velocity_m_s.head<2>();
  const Vec2 travel = velocity.norm() > 0.5 ? velocity : Vec2(ahead_on_way_m(lost, from) - from);
  lost.free_m = free_ahead_m(lost.ground, from, yaw_of(travel), kTravelHalf_rad,
                             params.search.search_sight_m);
  gather_near(lost, from, params);
}

void choose_viewpoint(LostPerson& lost, const SearchStep& step, const PlanningParams& params) {
  if (lost.judged < 0) {
    grow_reach(lost, step, params);
    if (!lost.reach.complete || lost.reach.goal < 0) return;
    gather_open_cells(lost);
    foresee(lost.cloud, lost.ground, lost.future);
    lost.best = Viewpoint{};
    lost.judged = 0;
    judge(lost, lost.reach.goal, is_there(lost, step.from_enu_m.head<2>()), params);
    if (lost.viewpoint.worth >= 0.0)
      judge(lost, lost.ground.cell_of(lost.viewpoint.at_m), true, params);
    return;
  }
  const int count = static_cast<int>(lost.reached.cells.size());
  for (int i = 0; i < kViewpointsAStep; ++i, ++lost.judged)
    judge(lost, lost.reached.cells[lost.cloud.random.integer(0, count - 1)], false, params);
  if (lost.judged < kViewpointsJudged) return;
  if (lost.best.worth >= 0.0) take_way(lost);
  lost.judged = -1;
  lost.reach.goal = -1;
}

double search_speed_m_s(const LostPerson& lost, const PlanningParams& params) {
  const double safe_m_s = safe_speed_m_s(lost.free_m, params.body.body_speed_m_s, params.search);
  const double least_m_s = std::min(params.view.search_speed_m_s, params.limits.speed_max_m_s);
  return std::clamp(safe_m_s, least_m_s, params.limits.speed_max_m_s);
}

Vec2 ahead_on_way_m(const LostPerson& lost, const Vec2& from) {
  if (lost.way.empty()) return from;
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < lost.way.size(); ++i)
    if ((lost.way[i] - from).squaredNorm() < (lost.way[nearest] - from).squaredNorm()) nearest = i;
  double left_m = kWayAhead_m;
  for (; nearest + 1 < lost.way.size() && left_m > 0.0; ++nearest)
    left_m -= (lost.way[nearest + 1] - lost.way[nearest]).norm();
  return lost.way[nearest];
}

void add_near_belief(const LostPerson& lost, double now_s, const GapParams& params,
                     BodyCourses& courses) {
  for (int i = 0; i < lost.near_count; ++i) {
    const NearBelief& near = lost.near[i];
    if (near.probability < params.course_probability_min) continue;
    MovingBody body;
    body.kind = BodyKind::kPerson;
    body.followed = true;
    body.stamp_s = now_s;
    body.height_m = params.person_height_m;
    body.radius_m = params.person_radius_m;
    body.position_enu_m << near.at_m, lost.torso_m - 0.674 * params.person_height_m;
    body.velocity_enu_m_s << near.velocity_m_s, 0.0;
    body.place_count = MovingBody::kMaxPlaces;
    for (int k = 0; k < body.place_count; ++k)
      body.places_enu_m[k] = body.position_enu_m + body.step_s * (k + 1) * body.velocity_enu_m_s;
    courses.add({body, near.probability, kNearHorizon_s});
  }
}

}  // namespace foretrack
