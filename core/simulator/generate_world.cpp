// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/generate_world.hpp"

#include <algorithm>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

constexpr double kPassage_m = 1.2;     // between scattered shapes
constexpr double kPathMargin_m = 1.0;  // around the polyline that is kept free
constexpr int kTriesPerShape = 40;

// A growing world and what it must keep clear of.
struct Builder {
  World world;
  std::span<const Vec2> keep_free;
  Random random;

  double ground_z() const { return world.min_m.z(); }
  Vec2 place(double margin_m) {
    const Vec2 low = world.min_m.head<2>(), high = world.max_m.head<2>();
    return {random.uniform(low.x() + margin_m, high.x() - margin_m),
            random.uniform(low.y() + margin_m, high.y() - margin_m)};
  }
  Box box(const Vec2& center, const Vec2& extent, double height_m) const {
    const Vec2 low = center - 0.5 * extent, high = center + 0.5 * extent;
    return {{low.x(), low.y(), ground_z()}, {high.x(), high.y(), ground_z() + height_m}};
  }
  bool leaves_path_free(const World& shape) const {
    for (std::size_t i = 0; i < keep_free.size(); ++i) {
      const Vec2& next = keep_free[std::min(i + 1, keep_free.size() - 1)];
      if (ground_clearance_m(shape, keep_free[i], next) < kPathMargin_m) return false;
    }
    return true;
  }
  void add(const Box& shape) {
    if (leaves_path_free({.boxes = {shape}, .cylinders = {}})) world.boxes.push_back(shape);
  }
  // Walls between two corners on the ground plane.
  void add(double x0, double y0, double x1, double y1, double height_m) {
    add(Box{{x0, y0, ground_z()}, {x1, y1, ground_z() + height_m}});
  }
  // True if nothing else is within kPassage_m of the shape's bounding rectangle.
  bool has_room(const Vec2& center, const Vec2& extent) const {
    const Vec2 half = 0.5 * extent + Vec2::Constant(kPassage_m);
    for (const auto& b : world.boxes)
      if (((b.min_m.head<2>() - center - half).array() < 0.0).all() &&
          ((center - half - b.max_m.head<2>()).array() < 0.0).all())
        return false;
    for (const auto& c : world.cylinders) {
      const Vec2 nearest =
          c.center_m.cwiseMax(center - 0.5 * extent).cwiseMin(center + 0.5 * extent);
      if ((nearest - c.center_m).norm() < c.radius_m + kPassage_m) return false;
    }
    return true;
  }
  template <class Make>
  void scatter(int count, Make&& make) {
    const auto wanted = world.boxes.size() + world.cylinders.size() + count;
    for (int i = 0; i < kTriesPerShape * count; ++i) {
      if (world.boxes.size() + world.cylinders.size() >= wanted) return;
      make();
    }
  }
  void try_box(const Vec2& extent, double height_m) {
    const Vec2 center = place(0.5 * extent.maxCoeff());
    if (has_room(center, extent)) add(box(center, extent, height_m));
  }
  void try_cylinder() {
    const double radius_m = random.uniform(0.25, 0.75);
    const Cylinder shape{place(radius_m), radius_m, random.uniform(3.5, 4.5), ground_z()};
    if (has_room(shape.center_m, Vec2::Constant(2.0 * radius_m)) &&
        leaves_path_free({.boxes = {}, .cylinders = {shape}}))
      world.cylinders.push_back(shape);
  }
};

void scatter_boxes(Builder& b, int count) {
  b.scatter(count, [&] {
    const Vec2 extent(b.random.uniform(0.5, 1.5), b.random.uniform(0.5, 1.5));
    b.try_box(extent, b.random.uniform(3.5, 4.5));
  });
}

void scatter_cylinders(Builder& b, int count) {
  b.scatter(count, [&] { b.try_cylinder(); });
}

// One wall for two cylinders.
void scatter_walls(Builder& b, int count) {
  b.scatter(count / 3, [&] {
    const double length_m = b.random.uniform(2.0, 5.0);
    const Vec2 extent = b.random.chance(0.5) ? Vec2(length_m, 0.2) : Vec2(0.2, length_m);
    b.try_box(extent, b.random.uniform(3.5, 4.5));
  });
  scatter_cylinders(b, count - count / 3);
}

void scatter_hedges(Builder& b, int count) {
  b.scatter(count, [&] {
    const double length_m = b.random.uniform(2.0, 5.0);
    b.try_box(b.random.chance(0.5) ? Vec2(length_m, 0.6) : Vec2(0.6, length_m), 1.3);
  });
}

// Blocks on a grid, some of them joined to their neighbour so that streets end in T-junctions.
void build_blocks(Builder& b) {
  constexpr double kPitch_m = 4.5, kStreet_m = 2.1, kBlock_m = kPitch_m - kStreet_m;
  const Vec2 low = b.world.min_m.head<2>(), extent = b.world.max_m.head<2>() - low;
  const Eigen::Vector2i n = (extent / kPitch_m).array().floor().cast<int>();
  const Vec2 first = low + 0.5 * (extent - kPitch_m * (n.cast<double>() - Vec2::Ones()));
  for (int y = 0; y < n.y(); ++y)
    for (int x = 0; x < n.x(); ++x) {
      const Vec2 center = first + kPitch_m * Vec2(x, y);
      const double height_m = b.random.uniform(3.5, 4.5);
      b.add(b.box(center, Vec2::Constant(kBlock_m), height_m));
      if (x + 1 < n.x() && b.random.chance(0.15))
        b.add(b.box(center + Vec2(0.5 * kPitch_m, 0.0), {kStreet_m, kBlock_m}, height_m));
    }
}

// Streets 3 m wide (2.6 to 3.4 by seed); the junction is at the origin.
void build_t_intersection(Builder& b) {
  const double half_m = 0.5 * b.random.uniform(2.6, 3.4), height_m = 4.5, reach_m = 14.0;
  b.add(-reach_m, half_m, -half_m, reach_m, height_m);
  b.add(-reach_m, -reach_m, -half_m, -half_m, height_m);
  b.add(half_m, -reach_m, half_m + 1.0, reach_m, height_m);
}

// A hallway along x, 3 m wide, with openings in one wall or the other.
void build_corridor(Builder& b) {
  constexpr double kHalf_m = 1.5, kThick_m = 0.3, kOpening_m = 2.0, kHeight_m = 4.5;
  const double low = b.world.min_m.x(), high = b.world.max_m.x();
  for (const int side : {-1, 1}) {
    const double y0 = side > 0 ? kHalf_m : -kHalf_m - kThick_m;
    double x = low;
    while (x < high) {
      const double end = std::min(x + b.random.uniform(3.0, 6.0), high);
      b.add(x, y0, end, y0 + kThick_m, kHeight_m);
      x = end + kOpening_m;
    }
  }
}

// Rooms 6 m square; each wall has one door.
void build_doorways(Builder& b) {
  constexpr double kRoom_m = 6.0, kThick_m = 0.2, kDoor_m = 1.6, kHeight_m = 4.0;
  const Vec2 low = b.world.min_m.head<2>(), high = b.world.max_m.head<2>();
  for (const int axis : {0, 1}) {
    const int along = 1 - axis;
    for (double wall = low[axis] + kRoom_m; wall < high[axis] - 1.0; wall += kRoom_m)
      for (double room = low[along]; room < high[along]; room += kRoom_m) {
        const double end = std::min(room + kRoom_m, high[along]);
        const double door = b.random.uniform(room + 0.8, room + kRoom_m - 0.8 - kDoor_m);
        for (const auto& [from, to] : {std::pair{room, door}, std::pair{door + kDoor_m, end}}) {
          if (to - from < 0.05) continue;
          if (axis == 0)
            b.add(wall - 0.5 * kThick_m, from, wall + 0.5 * kThick_m, to, kHeight_m);
          else
            b.add(from, wall - 0.5 * kThick_m, to, wall + 0.5 * kThick_m, kHeight_m);
        }
      }
  }
}

}  // namespace

World generate_world(const WorldGenerator& generator, const Vec3& min_m, const Vec3& max_m,
                     std::span<const Vec2> keep_free) {
  Builder b{{.min_m = min_m, .max_m = max_m, .boxes = {}, .cylinders = {}},
            keep_free,
            Random(generator.seed)};
  switch (generator.kind) {
    case WorldKind::kEmpty:
      break;
    case WorldKind::kBoxes:
      scatter_boxes(b, generator.count);
      break;
    case WorldKind::kCylinders:
      scatter_cylinders(b, generator.count);
      break;
    case WorldKind::kWalls:
      scatter_walls(b, generator.count);
      break;
    case WorldKind::kBlocks:
      build_blocks(b);
      break;
    case WorldKind::kTIntersection:
      build_t_intersection(b);
      break;
    case WorldKind::kCorridor:
      build_corridor(b);
      break;
    case WorldKind::kDoorways:
      build_doorways(b);
      break;
    case WorldKind::kHedges:
      scatter_hedges(b, generator.count);
      break;
  }
  return std::move(b.world);
}

}  // namespace foretrack
