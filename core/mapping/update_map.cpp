// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/update_map.hpp"

#include <octomap/OcTree.h>

#include <algorithm>
#include <array>
#include <limits>

#include "core/mapping/local_box.hpp"

namespace foretrack {
namespace {

using Vec3i = Eigen::Vector3i;

enum Mark : std::uint8_t { kUntouched, kPassed, kHit };

// A cylinder about a moving body, in which returns are its own.
struct BodyRoom {
  Vec3 foot_enu_m;
  double radius_m, height_m, margin_m;
  bool followed;

  bool contains(const Vec3& p) const { return is_within(p, margin_m, -margin_m); }
  /// In the body itself, above the ground that it stands on.
  bool is_of_body(const Vec3& p) const { return is_within(p, 0.0, margin_m); }

 private:
  bool is_within(const Vec3& p, double beside_m, double above_foot_m) const {
    const Vec3 offset = p - foot_enu_m;
    return offset.z() >= above_foot_m && offset.z() <= height_m + margin_m &&
           offset.head<2>().norm() <= radius_m + beside_m;
  }
};

struct BodyRooms {
  std::array<BodyRoom, MovingBodies::kCapacity> rooms;
  int count = 0;

  /// Null: the point is in none.
  const BodyRoom* find(const Vec3& p) const {
    for (int k = 0; k < count; ++k)
      if (rooms[k].contains(p)) return &rooms[k];
    return nullptr;
  }
};

// What stands still and may be no person is an obstacle like any other.
BodyRooms rooms_of(std::span<const MovingBody> bodies, double stamp_s,
                   const MappingParams& params) {
  BodyRooms all;
  for (const MovingBody& body : bodies) {
    const bool moves = body.velocity_enu_m_s.head<2>().norm() >= params.body_moves_m_s;
    if (body.kind == BodyKind::kUnknown && !moves) continue;
    if (all.count == MovingBodies::kCapacity) break;
    all.rooms[all.count++] = {body.expected_at(stamp_s), body.radius_m, body.height_m,
                              params.body_margin_m, body.followed};
  }
  return all;
}

// One image's rays, from the camera's place into the box.
struct Scan {
  MappingState& state;
  const DepthImage& image;
  const MappingParams& params;
  Pose T_world_camera;
  BodyRooms bodies;

  // In the camera, at z = 1.
  Vec3 ray_of(int u, int v) const {
    const CameraModel& c = image.camera;
    return {(u + 0.5 - c.cx_px) / c.fx_px, (v + 0.5 - c.cy_px) / c.fy_px, 1.0};
  }

  void mark(std::size_t offset, Mark value) {
    std::uint8_t& mark = state.marks[offset];
    if (mark == kUntouched) state.touched.push_back(static_cast<std::uint32_t>(offset));
    mark = std::max<std::uint8_t>(mark, value);
  }

  int mark_hits() {
    const int stride = std::max(1, image.camera.width_px / params.hit_columns);
    int hits = 0;
    for (int v = stride / 2; v < image.camera.height_px; v += stride)
      for (int u = stride / 2; u < image.camera.width_px; u += stride) hits += mark_hit(u, v);
    return hits;
  }

  bool mark_hit(int u, int v) {
    const double depth_m = image.depth_m[static_cast<std::size_t>(v) * image.camera.width_px + u];
    if (!(depth_m >= params.min_range_m && depth_m <= params.max_range_m)) return false;
    const Vec3 in_camera = depth_m * ray_of(u, v);
    if (in_camera.squaredNorm() > params.max_range_m * params.max_range_m) return false;
    const Vec3 point = T_world_camera * in_camera;
    const Vec3i cell = state.map.index_of(point);
    if (!state.map.contains(cell)) return false;
    const BodyRoom* body = bodies.find(point);
    if (!(body && body->followed) && is_open(cell) && is_open_around(cell))
      add_return(state.mover_columns, state.map, point);
    if (body) {
      // Nothing else stands where the body is, whatever was taken for an obstacle before.
      if (body->is_of_body(point)) mark(state.map.offset_of(cell), kPassed);
      return false;
    }
    mark(state.map.offset_of(cell), kHit);
    return true;
  }

  // Free, or free until lately.
  bool is_open(const Vec3i& cell) const {
    if (!state.map.contains(cell)) return false;
    const std::size_t offset = state.map.offset_of(cell);
    if (state.map.cells[offset] == static_cast<std::uint8_t>(Cell::kFree)) return true;
    return image.stamp_s - state.first_s - state.free_s[offset] <= params.mover_lately_s;
  }

  // Beside a wall that is seen at a grazing angle, the cells of its face and those before them are
  // seen free at times; but not its inside, which is two cells away at most.
  bool is_open_around(const Vec3i& cell) const {
    for (int dy = -2; dy <= 2; ++dy)
      for (int dx = -2; dx <= 2; ++dx)
        if (!is_open(cell + Vec3i(dx, dy, 0))) return false;
    return true;
  }

  int mark_rays() {
    const int stride = std::max(1, image.camera.width_px / params.ray_columns);
    int rays = 0;
    for (int v = stride / 2; v < image.camera.height_px; v += stride)
      for (int u = stride / 2; u < image.camera.width_px; u += stride) {
        const double depth_m =
            image.depth_m[static_cast<std::size_t>(v) * image.camera.width_px + u];
        if (!(depth_m >= params.min_range_m)) continue;
        const Vec3 direction = ray_of(u, v);
        const double per_depth = direction.norm();
        pass(T_world_camera.linear() * direction / per_depth,
             std::min(depth_m * per_depth, params.max_range_m));
        ++rays;
      }
    return rays;
  }

  // Marks the cells from the camera up to, not including, the cell at the ray's end (Amanatides
  // and Woo 1987). Stops at the side of the box: it is convex.
  void pass(const Vec3& direction, double length_m) {
    const Vec3i cell = state.map.index_of(T_world_camera.translation());
    if (!state.map.contains(cell)) return;
    Axis x = axis_of(0, cell, direction), y = axis_of(1, cell, direction),
         z = axis_of(2, cell, direction);
    auto offset = static_cast<std::ptrdiff_t>(state.map.offset_of(cell));
    std::uint8_t* const marks = state.marks.data();
    const auto leave_cell = [&](Axis& axis) {
      if (axis.next_m > length_m) return false;  // the ray ends in this cell
      if (marks[offset] == kUntouched) mark(static_cast<std::size_t>(offset), kPassed);
      if (axis.cells_left-- == 0) return false;
      offset += axis.step;
      axis.next_m += axis.delta_m;
      return true;
    };
    bool inside = true;
    while (inside)
      if (x.next_m < y.next_m)
        inside = x.next_m < z.next_m ? leave_cell(x) : leave_cell(z);
      else
        inside = y.next_m < z.next_m ? leave_cell(y) : leave_cell(z);
  }

  // A ray's way through the cells along one axis.
  struct Axis {
    double next_m, delta_m;  // along the ray: to the next face, between faces
    std::ptrdiff_t step;     // in the cells' memory
    int cells_left;          // to the side of the box
  };
  Axis axis_of(int a, const Vec3i& cell, const Vec3& direction) const {
    const GridMap& map = state.map;
    const std::ptrdiff_t strides[] = {1, map.size.x(),
                                      static_cast<std::ptrdiff_t>(map.size.x()) * map.size.y()};
    const bool forward = direction[a] >= 0.0;
    const int left = forward ? map.size[a] - 1 - cell[a] : cell[a];
    const std::ptrdiff_t step = forward ? strides[a] : -strides[a];
    constexpr double kNever = std::numeric_limits<double>::infinity();
    if (std::abs(direction[a]) < 1e-12) return {kNever, kNever, step, left};
    const double face_m = map.origin_enu_m[a] + map.resolution_m * (cell[a] + (forward ? 1 : 0));
    return {(face_m - T_world_camera.translation()[a]) / direction[a],
            map.resolution_m / std::abs(direction[a]), step, left};
  }
};

int apply_marks(MappingState& state, double stamp_s, const MappingParams& params) {
  const int hit = log_odds_steps(params.hit_log_odds), miss = log_odds_steps(params.miss_log_odds);
  const int low = log_odds_steps(params.min_log_odds), high = log_odds_steps(params.max_log_odds);
  const auto now_s = static_cast<float>(stamp_s - state.first_s);
  int changed = 0;
  for (const std::uint32_t offset : state.touched) {
    const int change = state.marks[offset] == kHit ? hit : -miss;
    const std::int8_t before = state.log_odds[offset];
    const int sum = (before == kUnknownLogOdds ? 0 : before) + change;
    const auto after = static_cast<std::int8_t>(std::clamp(sum, low, high));
    if (after != before) changed += set_log_odds(state, offset, after);
    if (after < 0) state.free_s[offset] = now_s;
    state.marks[offset] = kUntouched;
  }
  return changed;
}

constexpr double kReachCosine = 0.26;  // 75° about the camera's axis

// A ball, or the part of it within an angle of an axis.
struct Room {
  Vec3 centre_enu_m;
  double radius_m;
  Vec3 axis = Vec3::Zero();
  double cos_angle = 0.0;

  bool contains(const Vec3& place_enu_m) const {
    const Vec3 offset = place_enu_m - centre_enu_m;
    const double distance_m = offset.norm();
    return distance_m <= radius_m && axis.dot(offset) >= cos_angle * distance_m;
  }
};

// Makes what is unknown in the room free.
int set_free(MappingState& state, const Room& room, const MappingParams& params) {
  const Vec3 reach = Vec3::Constant(room.radius_m);
  const Vec3i low = state.map.index_of(room.centre_enu_m - reach).cwiseMax(0);
  const Vec3i high =
      state.map.index_of(room.centre_enu_m + reach).cwiseMin(state.map.size - Vec3i::Ones());
  const std::int8_t free = log_odds_steps(params.min_log_odds);
  int changed = 0;
  for (int z = low.z(); z <= high.z(); ++z)
    for (int y = low.y(); y <= high.y(); ++y)
      for (int x = low.x(); x <= high.x(); ++x) {
        const std::size_t offset = state.map.offset_of({x, y, z});
        if (state.log_odds[offset] == kUnknownLogOdds &&
            room.contains(state.map.center_of({x, y, z})))
          changed += set_log_odds(state, offset, free);
      }
  return changed;
}

}  // namespace

MappingState::MappingState(const MappingParams& params) {
  MappingParams copy = params;
  validate_or_throw("mapping", rows(copy));
  tree = std::make_unique<octomap::OcTree>(params.resolution_m);
  map.resolution_m = params.resolution_m;
  map.size = box_size(params);
  log_odds.assign(map.cell_count(), kUnknownLogOdds);
  free_s.assign(map.cell_count(), kNeverFree_s);
  marks.assign(map.cell_count(), kUntouched);
  mover_columns.columns.resize(static_cast<std::size_t>(map.size.x()) * map.size.y());
  mover_columns.touched.reserve(mover_columns.columns.size());
  mover_columns.stack.reserve(mover_columns.columns.size());
  touched.reserve(map.cell_count());
  base.setZero();
}

MappingState::MappingState(MappingState&&) noexcept = default;
MappingState& MappingState::operator=(MappingState&&) noexcept = default;
MappingState::~MappingState() = default;

std::string_view to_string(MapStatus status) {
  constexpr std::array<std::string_view, 3> names = {"updated", "no pose of the vehicle",
                                                     "invalid image"};
  return names.at(static_cast<std::size_t>(status));
}

MapUpdate update_map(MappingState& state, const DepthImage& image, const VehicleHistory& vehicle,
                     std::span<const MovingBody> bodies, const MappingParams& params) {
  MapUpdate update;
  const CameraModel& camera = image.camera;
  if (camera.width_px <= 0 || camera.height_px <= 0 ||
      image.depth_m.size() != static_cast<std::size_t>(camera.width_px) * camera.height_px) {
    update.status = MapStatus::kInvalidImage;
    return update;
  }
  const auto at_image = vehicle.at(image.stamp_s);
  if (!at_image) {
    update.status = MapStatus::kNoVehiclePose;
    return update;
  }
  const bool starts = !state.placed;
  if (starts) {
    state.map.cells.assign(state.map.cell_count(), static_cast<std::uint8_t>(Cell::kUnknown));
    state.first_s = image.stamp_s;
  }
  update.scrolled = follow_vehicle(state, at_image->position_enu_m, params);

  Scan scan{state, image, params, at_image->T_world_body() * camera.T_body_camera,
            rooms_of(bodies, image.stamp_s, params)};
  state.touched.clear();
  update.hits = scan.mark_hits();
  find_movers(state.mover_columns, state.map, scan.T_world_camera.translation(), params,
              state.movers);
  state.movers.stamp_s = image.stamp_s;
  update.rays = scan.mark_rays();
  update.touched_cells = static_cast<int>(state.touched.size());
  update.changed_cells = apply_marks(state, image.stamp_s, params);
  // The vehicle is there, so it is free, though the camera never sees it.
  const Vec3& place = at_image->position_enu_m;
  const double bubble_m = starts ? params.start_bubble_m : params.vehicle_bubble_m;
  update.changed_cells += set_free(state, {place, bubble_m}, params);
  // Its way to where the field of view is wide enough for it is not seen either: without room
  // there, a vehicle that hovers would be shut in.
  const double reach_m = starts ? params.start_reach_m : params.vehicle_reach_m;
  const Vec3 axis = scan.T_world_camera.linear().col(2);
  update.changed_cells += set_free(state, {place, reach_m, axis, kReachCosine}, params);
  if (update.changed_cells > 0 || update.scrolled) update_distances(state.map, state.distances);
  state.map.stamp_s = image.stamp_s;
  return update;
}

std::span<const MovingBody> bodies_at(double stamp_s, const MovingBodies& bodies,
                                      const MappingParams& params) {
  const bool is_stale = std::abs(stamp_s - bodies.stamp_s) > params.bodies_stale_s;
  return is_stale ? std::span<const MovingBody>() : bodies.all();
}

const GridMap& local_map(const MappingState& state) {
  return state.map;
}

}  // namespace foretrack
