// SPDX-License-Identifier: Apache-2.0
#include "core/planning/search/search_ground.hpp"

#include <algorithm>
#include <array>

namespace foretrack {
namespace {

constexpr std::array<double, 4> kBodyHeights_m = {-0.6, -0.2, 0.2, 0.5};  // from the torso's centre
constexpr std::array<double, 2> kSightHeights_m = {0.0, 0.2};
constexpr int kLooksNeeded = 3;
constexpr double kRayStepCells = 0.5;
constexpr double kRayWidthCells = 0.9;  // of the outermost cells

// Cells of the map above one of its columns at some heights; −1 for heights that it does not hold.
template <std::size_t N>
std::array<std::ptrdiff_t, N> layers_at(const GridMap& map, double torso_m,
                                        const std::array<double, N>& heights_m) {
  std::array<std::ptrdiff_t, N> layers{};
  for (std::size_t i = 0; i < N; ++i) {
    const double z = (torso_m + heights_m[i] - map.origin_enu_m.z()) / map.resolution_m;
    const bool inside = z >= 0.0 && z < map.size.z();
    layers[i] = inside ? static_cast<std::ptrdiff_t>(z) * map.size.x() * map.size.y() : -1;
  }
  return layers;
}

// Bit masks of whole rows, so that the compiler makes vectors of them.
void spread_cross(const std::uint8_t* what, const std::uint8_t* in, std::uint8_t* out) {
  for (int i = kGroundSide; i < kGroundSide * (kGroundSide - 1); ++i) {
    const std::uint8_t beside = in[i - 1] | in[i + 1] | in[i - kGroundSide] | in[i + kGroundSide];
    out[i] = static_cast<std::uint8_t>(in[i] | (beside & (what[i] ^ 1) & 1));
  }
}
void spread_beside(const std::uint8_t* what, const std::uint8_t* in, std::uint8_t* out, int by) {
  for (int i = kGroundSide; i < kGroundSide * (kGroundSide - 1); ++i)
    out[i] = static_cast<std::uint8_t>(in[i] | ((in[i - by] | in[i + by]) & (what[i] ^ 1) & 1));
}

// Visits the cells of a ray until visit says false.
template <class Visit>
void along_ray(const SearchGround& g, const Vec2& from, const Vec2& direction, double range_m,
               Visit&& visit) {
  const double step_m = kRayStepCells * g.resolution_m;
  const int steps = static_cast<int>(range_m / step_m);
  const Vec2 step = kRayStepCells * direction;
  Vec2 at = (from - g.corner_m) / g.resolution_m;
  int last = -1;
  for (int i = 1; i <= steps; ++i) {
    at += step;
    if (at.x() < 0.0 || at.y() < 0.0 || at.x() >= kGroundSide || at.y() >= kGroundSide) return;
    const int cell = static_cast<int>(at.y()) * kGroundSide + static_cast<int>(at.x());
    if (cell == last) continue;
    last = cell;
    if (!visit(cell, i * step_m)) return;
  }
}

template <class Visit>
void fan(const SearchGround& g, const Vec2& from, double yaw_rad, double half_angle_rad,
         double range_m, Visit&& visit) {
  const int rays =
      1 + static_cast<int>(2.0 * half_angle_rad * range_m / (kRayWidthCells * g.resolution_m));
  for (int i = 0; i <= rays; ++i)
    along_ray(g, from, direction_of(yaw_rad + half_angle_rad * (2.0 * i / rays - 1.0)), range_m,
              visit);
}

void wall_in(SearchGround& g) {
  for (int i = 0; i < kGroundSide; ++i)
    for (const int cell : {i, kGroundSide * (kGroundSide - 1) + i, kGroundSide * i,
                           kGroundSide * i + kGroundSide - 1})
      g.what[cell] = SearchGround::kWall | SearchGround::kScreen;
}

}  // namespace

void reserve(SearchGround& g) {
  for (auto* layer : {&g.what, &g.may_be, &g.looks, &g.look_of, &g.scratch})
    layer->assign(static_cast<std::size_t>(kGroundSide) * kGroundSide, 0);
}

void begin_ground(SearchGround& g, const GridMap& map, const Vec3& torso) {
  reserve(g);
  g.resolution_m = map.resolution_m;
  g.torso_m = torso.z();
  const Eigen::Vector2i middle = map.index_of(torso).head<2>();
  g.corner_m =
      map.origin_enu_m.head<2>() +
      map.resolution_m * (middle - Eigen::Vector2i::Constant(kGroundSide / 2)).cast<double>();
  g.map_stamp_s = -1.0;
  g.look = 0;
  g.to_spread_m = 0.0;
  read_map(g, map);
  // The person stands there, whatever the map takes for an obstacle.
  const int cell = g.cell_of(torso.head<2>());
  for (const int by : {0, 1, -1, kGroundSide, -kGroundSide})
    g.what[cell + by] &= ~SearchGround::kWall;
  g.may_be[cell] = 1;
}

void read_map(SearchGround& g, const GridMap& map) {
  if (map.stamp_s == g.map_stamp_s) return;
  g.map_stamp_s = map.stamp_s;
  const auto body = layers_at(map, g.torso_m, kBodyHeights_m);
  const auto sight = layers_at(map, g.torso_m, kSightHeights_m);
  const Vec2 offset = (g.corner_m - map.origin_enu_m.head<2>()) / map.resolution_m;
  const int dx = static_cast<int>(std::lround(offset.x()));
  const int dy = static_cast<int>(std::lround(offset.y()));
  const std::uint8_t beyond = map.stamp_s == 0.0 ? SearchGround::kWall : 0;
  const auto is_occupied = [&](std::ptrdiff_t layer, std::ptrdiff_t column) {
    return layer >= 0 && map.cells[layer + column] == static_cast<std::uint8_t>(Cell::kOccupied);
  };
  for (int y = 0; y < kGroundSide; ++y)
    for (int x = 0; x < kGroundSide; ++x) {
      std::uint8_t& what = g.what[y * kGroundSide + x];
      const int mx = x + dx, my = y + dy;
      if (mx < 0 || my < 0 || mx >= map.size.x() || my >= map.size.y()) {
        what |= beyond;
        continue;
      }
      const std::ptrdiff_t column = static_cast<std::ptrdiff_t>(my) * map.size.x() + mx;
      const bool wall = std::ranges::any_of(body, [&](auto l) { return is_occupied(l, column); });
      const bool screen =
          std::ranges::all_of(sight, [&](auto l) { return is_occupied(l, column); });
      what = static_cast<std::uint8_t>((wall ? SearchGround::kWall : 0) |
                                       (screen ? SearchGround::kScreen : 0));
    }
  wall_in(g);
}

void spread(SearchGround& g, double distance_m) {
  g.to_spread_m += distance_m;
  for (; g.to_spread_m >= g.resolution_m; g.to_spread_m -= g.resolution_m) {
    // In turns a diamond, a square, a square the other way round: nearly a circle.
    const int kind = g.spreads++ % 4;
    if (kind % 2 == 0) {
      spread_cross(g.what.data(), g.may_be.data(), g.scratch.data());
      std::swap(g.may_be, g.scratch);
    } else {
      const int first = kind == 1 ? 1 : kGroundSide;
      spread_beside(g.what.data(), g.may_be.data(), g.scratch.data(), first);
      spread_beside(g.what.data(), g.scratch.data(), g.may_be.data(), kGroundSide + 1 - first);
    }
  }
}

void look_in_vain(SearchGround& g, const Vec2& from, double yaw_rad, double half_angle_rad,
                  double range_m) {
  const std::uint8_t before = g.look++;
  fan(g, from, yaw_rad, half_angle_rad, range_m, [&](int cell, double) {
    if ((g.what[cell] & SearchGround::kScreen) != 0) return false;
    if (g.look_of[cell] == g.look) return true;
    const bool again = g.look_of[cell] == before;
    g.looks[cell] = again ? static_cast<std::uint8_t>(std::min(g.looks[cell] + 1, 200)) : 1;
    g.look_of[cell] = g.look;
    if (g.looks[cell] >= kLooksNeeded) g.may_be[cell] = 0;
    return true;
  });
}

bool is_in_sight(const SearchGround& g, const Vec2& from, const Vec2& to) {
  const Vec2 span = to - from;
  const double length_m = span.norm();
  if (length_m < 1e-6) return true;
  bool clear = true;
  along_ray(g, from, span / length_m, length_m,
            [&](int cell, double) { return clear = (g.what[cell] & SearchGround::kScreen) == 0; });
  return clear;
}

double free_ahead_m(const SearchGround& g, const Vec2& from, double yaw_rad, double half_angle_rad,
                    double range_m) {
  double least_m = range_m;
  fan(g, from, yaw_rad, half_angle_rad, range_m, [&](int cell, double at_m) {
    if ((g.what[cell] & SearchGround::kWall) != 0 || at_m >= least_m) return false;
    if (g.may_be[cell] == 0) return true;
    least_m = at_m;
    return false;
  });
  return least_m;
}

}  // namespace foretrack
