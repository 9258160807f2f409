// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/route.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

constexpr double kBeside_m = 0.45;  // places lie this far from both faces of a corner
constexpr double kFromBounds_m = 1.5;
constexpr double kLeastLeg_m = 2.0, kLongestLeg_m = 9.0;
constexpr double kSlack_m = 0.1;  // beside the person's radius
constexpr double kLeastTurn_rad = rad(50.0), kGreatestTurn_rad = rad(135.0);
constexpr int kMaxSteps = 20000;

struct Place {
  Vec2 point_m = Vec2::Zero();
  std::optional<std::vector<int>> next;  // that can be walked to; worked out when first asked for
};

class Search {
 public:
  Search(const World& world, const RouteRequest& request)
      : world_(world), request_(request), random_(request.seed) {}

  std::vector<Vec2> run() {
    find_places();
    std::vector<Vec2> best;
    double best_m = 0.0;
    for (int attempt = 0; attempt < 20 && best_m < request_.length_m; ++attempt) {
      std::vector<int> walk = random_walk();
      double length_m = 0.0;
      for (std::size_t i = 1; i < walk.size(); ++i) length_m += leg(walk[i - 1], walk[i]).norm();
      if (length_m <= best_m) continue;
      best_m = length_m;
      best.clear();
      for (const int place : walk) best.push_back(places_[place].point_m);
    }
    if (best.size() < 2)
      throw std::invalid_argument("generate_route: the world leaves no way to walk");
    return best;
  }

 private:
  Vec2 leg(int a, int b) const { return places_[b].point_m - places_[a].point_m; }
  bool is_free(const Vec2& a, const Vec2& b, double margin_m) const {
    return ground_clearance_m(world_, a, b) >= margin_m;
  }

  void add_place(const Vec2& p) {
    const Vec2 low = world_.min_m.head<2>() + Vec2::Constant(kFromBounds_m);
    const Vec2 high = world_.max_m.head<2>() - Vec2::Constant(kFromBounds_m);
    const bool inside = (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
    if (inside && is_free(p, p, request_.person_radius_m + kSlack_m))
      places_.push_back({.point_m = p, .next = {}});
  }

  void find_places() {
    for (const auto& b : world_.boxes)
      for (int corner = 0; corner < 4; ++corner) {
        const bool east = corner & 1, north = corner & 2;
        add_place({east ? b.max_m.x() + kBeside_m : b.min_m.x() - kBeside_m,
                   north ? b.max_m.y() + kBeside_m : b.min_m.y() - kBeside_m});
      }
    for (const auto& c : world_.cylinders)
      for (int k = 0; k < 6; ++k)
        add_place(c.center_m + (c.radius_m + 1.3 * kBeside_m) * direction_of(k * kPi / 3.0));
    while (places_.size() < 40)
      if (!add_random_place()) break;
  }

  const std::vector<int>& next_of(int a) {
    auto& next = places_[a].next;
    if (next) return *next;
    next.emplace();
    for (int b = 0; b < static_cast<int>(places_.size()); ++b) {
      const double length_m = leg(a, b).norm();
      if (length_m < kLeastLeg_m || length_m > kLongestLeg_m) continue;
      if (is_free(places_[a].point_m, places_[b].point_m, request_.person_radius_m + kSlack_m))
        next->push_back(b);
    }
    return *next;
  }

  bool add_random_place() {
    const std::size_t before = places_.size();
    for (int i = 0; i < 100 && places_.size() == before; ++i)
      add_place({random_.uniform(world_.min_m.x(), world_.max_m.x()),
                 random_.uniform(world_.min_m.y(), world_.max_m.y())});
    return places_.size() > before;
  }

  // The walk cuts a corner within the triangle of the corner and the two points reach before and
  // after it.
  bool corner_is_free(int a, int b, int c) const {
    const Vec2 &p = places_[b].point_m, in = leg(a, b).normalized(), out = leg(b, c).normalized();
    return is_free(p - request_.corner_reach_m * in, p + request_.corner_reach_m * out,
                   request_.person_radius_m);
  }

  std::vector<int> choices_after(const std::vector<int>& walk, double least_turn_rad) {
    std::vector<int> choices;
    const int here = walk.back();
    for (const int next : next_of(here)) {
      if (walk.size() >= 2) {
        const int before = walk[walk.size() - 2];
        const double turn =
            std::abs(wrap_angle(yaw_of(leg(here, next)) - yaw_of(leg(before, here))));
        if (turn < least_turn_rad || turn > kGreatestTurn_rad) continue;
        if (!corner_is_free(before, here, next)) continue;
      }
      choices.push_back(next);
    }
    return choices;
  }

  // Steps back from dead ends.
  std::vector<int> random_walk() {
    if (places_.empty()) return {};
    std::vector<int> walk = {random_.integer(0, static_cast<int>(places_.size()) - 1)};
    double length_m = 0.0;
    for (int step = 0; step < kMaxSteps && length_m < request_.length_m && !walk.empty(); ++step) {
      auto choices = choices_after(walk, kLeastTurn_rad);
      if (choices.empty()) choices = choices_after(walk, 0.0);
      if (choices.empty()) {
        if (walk.size() > 1) length_m -= leg(walk[walk.size() - 2], walk.back()).norm();
        walk.pop_back();
        continue;
      }
      const int next = choices[random_.integer(0, static_cast<int>(choices.size()) - 1)];
      length_m += leg(walk.back(), next).norm();
      walk.push_back(next);
    }
    return walk;
  }

  const World& world_;
  RouteRequest request_;
  Random random_;
  std::vector<Place> places_;
};

}  // namespace

std::vector<Vec2> generate_route(const World& world, const RouteRequest& request) {
  return Search(world, request).run();
}

std::vector<Vec2> t_intersection_route(const RouteRequest& request) {
  constexpr double kStem_m = -11.0, kAround_m = 16.0;
  Random random(request.seed);
  std::vector<Vec2> route = {{kStem_m, random.uniform(-0.3, 0.3)}};
  double length_m = 0.0;
  const auto go_to = [&](const Vec2& p) {
    length_m += (p - route.back()).norm();
    route.push_back(p);
  };
  while (length_m < request.length_m) {
    const double side = random.chance(0.5) ? 1.0 : -1.0;
    const double x = random.uniform(-0.3, 0.3), y = random.uniform(-0.3, 0.3);
    go_to({x, route.back().y()});
    go_to({x, side * kAround_m});
    go_to({-kAround_m, side * kAround_m});
    go_to({-kAround_m, y});
  }
  return route;
}

}  // namespace foretrack
