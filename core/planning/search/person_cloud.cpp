// SPDX-License-Identifier: Apache-2.0
#include "core/planning/search/person_cloud.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack {
namespace {

constexpr double kPathSpread_m_s = 0.15;  // of walkers about a believed path
constexpr double kLeastSpread_m = 0.1;
constexpr int kErrandTries = 8;
constexpr int kErrandExpansions = 25000;  // of errands, in one call
constexpr double kErrandNear_m = 1.5, kErrandFar_m = 24.0;
constexpr double kOpenErrands = 0.5;         // share
constexpr double kStandsShare = 0.3;         // of those who arrive
constexpr double kStands_s = 4.0;            // mean
constexpr double kTurnsRound = 0.15;         // as likely as to go straight on
constexpr double kPaceSigma = 0.15;          // of speeds, logarithmic
constexpr int kArrived = 3;                  // steps
constexpr double kLeastWalkerWeight = 0.05;  // of the mean
constexpr double kLeastEvidence = 0.005;
constexpr double kEvidenceRegained = 1.05;  // a look
constexpr double kCrowd_m = 1.0;
constexpr int kDoubted = 1;  // walkers, in each look

bool is_on_errand(const Walker& w, const PersonCloud& cloud) {
  return w.errand >= 0 && cloud.errands[w.errand].number == w.errand_number;
}

double standing_time_s(Random& random) {
  return random.chance(kStandsShare) ? -kStands_s * std::log(1.0 - random.uniform()) : 0.0;
}

// The direction in which the errand's way leads from here.
Vec2 direction_on(const DistanceField& way, const SearchGround& ground, int cell) {
  int to = cell;
  for (int i = 0; i < 4; ++i) to = downhill(way, to);
  const Vec2 span = ground.center_of(to) - ground.center_of(cell);
  return span.norm() > 1e-9 ? Vec2(span.normalized()) : Vec2::Zero();
}

// Any errand that leads from here, rather one that does not turn the walker round.
void choose_errand(Walker& w, const PersonCloud& cloud, const SearchGround& ground,
                   Random& random) {
  const int cell = ground.cell_of(w.at_m);
  w.errand = -1;
  for (int i = 0; i < kErrandTries; ++i) {
    const int e = random.integer(0, PersonCloud::kErrands - 1);
    const Errand& errand = cloud.errands[e];
    if (!errand.way.complete || errand.way.steps[cell] == DistanceField::kNever ||
        errand.way.steps[cell] <= kArrived)
      continue;
    const double ahead = 0.5 * (1.0 + w.heading.dot(direction_on(errand.way, ground, cell)));
    w.errand = e;
    w.errand_number = errand.number;
    if (random.chance(kTurnsRound + (1.0 - kTurnsRound) * ahead * ahead)) return;
  }
}

void go_straight(Walker& w, const SearchGround& ground, double dt_s) {
  const Vec2 to = w.at_m + dt_s * w.speed_m_s * w.heading;
  if (ground.is_walkable(ground.cell_of(to)))
    w.at_m = to;
  else
    w.heading = Vec2(-w.heading.y(), w.heading.x());
}

void go_on_errand(Walker& w, const DistanceField& way, const SearchGround& ground, double dt_s) {
  double left_m = dt_s * w.speed_m_s;
  for (int i = 0; i < 8 && left_m > 1e-9; ++i) {
    const int cell = ground.cell_of(w.at_m);
    const Vec2 span = ground.center_of(downhill(way, cell)) - w.at_m;
    const double length_m = span.norm();
    if (length_m < 1e-9) return;
    const double step_m = std::min(left_m, length_m);
    w.heading = span / length_m;
    w.at_m += step_m * w.heading;
    left_m -= step_m;
  }
}

int errand_goal(PersonCloud& cloud, const SearchGround& ground) {
  Random& random = cloud.random;
  if (cloud.open_count > 0 && random.chance(kOpenErrands))
    return cloud.open_cells[random.integer(0, cloud.open_count - 1)];
  const Vec2 from = cloud.walkers[random.integer(0, PersonCloud::kWalkers - 1)].at_m;
  return ground.cell_of(from + random.uniform(kErrandNear_m, kErrandFar_m) *
                                   direction_of(random.uniform(-kPi, kPi)));
}

double pace(const PersonCloud& cloud, Random& random) {
  return std::clamp(cloud.speed_m_s * std::exp(random.normal(0.0, kPaceSigma)), 0.3, 4.0);
}

// A place on the path, somewhat beside it.
bool place_on(const PredictedPath& path, double time_s, const PersonCloud& cloud,
              const SearchGround& ground, Random& random, Walker& w) {
  const PathPoint point = path.at(std::min(time_s, path.states.back().time_s));
  const Vec2 velocity = point.velocity_enu_m_s.head<2>();
  const double sigma_m = kLeastSpread_m + kPathSpread_m_s * time_s;
  w.at_m = point.position_enu_m.head<2>() + sigma_m * Vec2(random.normal(), random.normal());
  w.heading =
      velocity.norm() > 0.2 ? Vec2(velocity.normalized()) : direction_of(random.uniform(-kPi, kPi));
  w.speed_m_s = pace(cloud, random);
  return ground.is_walkable(ground.cell_of(w.at_m)) && ground.may_be[ground.cell_of(w.at_m)] != 0;
}

// Somewhere where the person can be.
Vec2 any_place(const SearchGround& ground, Random& random) {
  const int cells = kGroundSide * kGroundSide, first = random.integer(0, cells - 1);
  for (int i = 0; i < cells; ++i)
    if (const int cell = (first + i * 7919) % cells; ground.may_be[cell] != 0)
      return ground.center_of(cell);
  return ground.center_of(kGroundSide / 2 * kGroundSide + kGroundSide / 2);
}

void begin_anywhere(PersonCloud& cloud, const SearchGround& ground) {
  for (Walker& w : cloud.walkers) {
    w.at_m = any_place(ground, cloud.random);
    w.heading = direction_of(cloud.random.uniform(-kPi, kPi));
    w.speed_m_s = pace(cloud, cloud.random);
    w.weight = 1.0 / PersonCloud::kWalkers;
    w.stands_s = 0.0;
    choose_errand(w, cloud, ground, cloud.random);
  }
  cloud.evidence = 1.0;
}

// Whatever the walkers were thought to do: the person can be wherever they can have come.
void doubt(PersonCloud& cloud, const SearchGround& ground) {
  for (int i = 0; i < kDoubted; ++i) {
    Walker& w = cloud.walkers[cloud.random.integer(0, PersonCloud::kWalkers - 1)];
    w.at_m = any_place(ground, cloud.random);
    choose_errand(w, cloud, ground, cloud.random);
  }
}

// Shares the weight of some other walker, and goes somewhere else.
void replace(Walker& w, PersonCloud& cloud, const SearchGround& ground, double heaviest) {
  for (int i = 0; i < 64; ++i) {
    Walker& other = cloud.walkers[cloud.random.integer(0, PersonCloud::kWalkers - 1)];
    if (&other == &w || other.weight < cloud.random.uniform() * heaviest) continue;
    other.weight *= 0.5;
    w = other;
    w.speed_m_s = pace(cloud, cloud.random);
    choose_errand(w, cloud, ground, cloud.random);
    return;
  }
}

}  // namespace

void reserve(PersonCloud& cloud) {
  for (Errand& errand : cloud.errands) reserve(errand.way);
  reserve(cloud.queue);
}

void begin_cloud(PersonCloud& cloud, const SearchGround& ground, const TargetBelief& belief,
                 double now_s, const SearchParams& params) {
  for (Errand& errand : cloud.errands) {
    errand.way.goal = -1;
    errand.way.complete = false;
    ++errand.number;
  }
  cloud.making = cloud.open_count = 0;
  cloud.evidence = 1.0;
  cloud.queue.cells.clear();
  cloud.queue.next = 0;
  const double seen_m_s = belief.paths[0].states.front().velocity_enu_m_s.head<2>().norm();
  cloud.speed_m_s = seen_m_s > 0.4 ? seen_m_s : params.search_walk_speed_m_s;
  const double age_s = std::max(now_s - belief.stamp_s, 0.0);
  for (Walker& w : cloud.walkers) {
    w = Walker{};
    w.weight = 1.0 / PersonCloud::kWalkers;
    double draw = cloud.random.uniform();
    int path = 0;
    while (path + 1 < belief.count && draw > belief.paths[path].probability)
      draw -= belief.paths[path++].probability;
    bool placed = false;
    // A path that leads into a wall is followed as far as it is free.
    for (double time_s = age_s; !placed && time_s >= 0.0; time_s -= 0.1)
      placed = place_on(belief.paths[path], time_s, cloud, ground, cloud.random, w);
    if (!placed) w.at_m = any_place(ground, cloud.random);
  }
}

void plan_errands(PersonCloud& cloud, const SearchGround& ground) {
  Errand& errand = cloud.errands[cloud.making];
  const auto walkable = [&](int cell) { return (ground.what[cell] & SearchGround::kWall) == 0; };
  if (errand.way.goal < 0) {
    const int cell = errand_goal(cloud, ground);
    if (!ground.is_walkable(cell)) return;
    ++errand.number;
    begin_field(errand.way, cloud.queue, cell);
  }
  grow_field(errand.way, cloud.queue, kErrandExpansions, DistanceField::kNever - 1, walkable);
  if (!errand.way.complete) return;
  cloud.making = (cloud.making + 1) % PersonCloud::kErrands;
  cloud.errands[cloud.making].way.goal = -1;
  cloud.errands[cloud.making].way.complete = false;
}

void walk_on(Walker& w, const PersonCloud& cloud, const SearchGround& ground, double dt_s,
             Random& random) {
  w.stands_s -= dt_s;
  if (w.stands_s > 0.0) return;
  const int cell = ground.cell_of(w.at_m);
  if (cell < 0) return;
  if (!is_on_errand(w, cloud)) choose_errand(w, cloud, ground, random);
  if (w.errand < 0) return go_straight(w, ground, dt_s);
  const DistanceField& way = cloud.errands[w.errand].way;
  if (!way.complete || way.steps[cell] == DistanceField::kNever) {
    w.errand = -1;
    return go_straight(w, ground, dt_s);
  }
  if (way.steps[cell] <= kArrived) {
    w.stands_s = standing_time_s(random);
    choose_errand(w, cloud, ground, random);
    return;
  }
  go_on_errand(w, way, ground, dt_s);
}

void walk_on(PersonCloud& cloud, const SearchGround& ground, double dt_s) {
  for (Walker& w : cloud.walkers) walk_on(w, cloud, ground, dt_s, cloud.random);
}

void look_in_vain(PersonCloud& cloud, const SearchGround& ground, const Vec2& from, double yaw_rad,
                  double half_angle_rad, const SearchParams& params) {
  double sum = 0.0;
  for (Walker& w : cloud.walkers) {
    const Vec2 span = w.at_m - from;
    const int cell = ground.cell_of(w.at_m);
    const bool in_view = span.norm() < params.search_sight_m &&
                         std::abs(wrap_angle(yaw_of(span) - yaw_rad)) < half_angle_rad;
    if (cell < 0 || !ground.is_walkable(cell))
      w.weight = 0.0;
    else if (in_view && is_in_sight(ground, from, w.at_m))
      w.weight *= params.search_miss_per_look;
    sum += w.weight;
  }
  cloud.evidence = std::min(1.0, kEvidenceRegained * cloud.evidence * sum);
  if (cloud.evidence < kLeastEvidence) return begin_anywhere(cloud, ground);
  const double least = sum * kLeastWalkerWeight / PersonCloud::kWalkers;
  double kept = 0.0, heaviest = 0.0;
  for (Walker& w : cloud.walkers) {
    if (w.weight < least) w.weight = 0.0;
    kept += w.weight;
  }
  for (Walker& w : cloud.walkers) {
    w.weight /= kept;
    heaviest = std::max(heaviest, w.weight);
  }
  for (Walker& w : cloud.walkers)
    if (w.weight == 0.0) replace(w, cloud, ground, heaviest);
  doubt(cloud, ground);
}

Vec2 likeliest_place_m(const PersonCloud& cloud) {
  double most = -1.0;
  Vec2 best = cloud.walkers[0].at_m;
  // Every fourth is enough to find the crowd.
  for (int i = 0; i < PersonCloud::kWalkers; i += 4) {
    double near = 0.0;
    for (const Walker& other : cloud.walkers)
      if ((other.at_m - cloud.walkers[i].at_m).squaredNorm() < kCrowd_m * kCrowd_m)
        near += other.weight;
    if (near > most) most = near, best = cloud.walkers[i].at_m;
  }
  return best;
}

}  // namespace foretrack
