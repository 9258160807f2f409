// SPDX-License-Identifier: Apache-2.0
#include "core/common/grid_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace foretrack {
namespace {

using Vec3i = Eigen::Vector3i;

// Visits the cells on the segment in order (Amanatides and Woo 1987); stops when visit returns
// false. Returns the distance travelled at the stop, or the segment's length.
template <class Visit>
double traverse(const GridMap& map, const Vec3& from, const Vec3& direction, double length_m,
                Visit&& visit) {
  Eigen::Vector3i cell = map.index_of(from);
  Eigen::Vector3i step;
  Vec3 next, delta;
  for (int a = 0; a < 3; ++a) {
    step[a] = direction[a] >= 0.0 ? 1 : -1;
    const double face = map.origin_enu_m[a] + map.resolution_m * (cell[a] + (step[a] > 0 ? 1 : 0));
    const bool still = std::abs(direction[a]) < 1e-12;
    next[a] = still ? std::numeric_limits<double>::infinity() : (face - from[a]) / direction[a];
    delta[a] =
        still ? std::numeric_limits<double>::infinity() : map.resolution_m / std::abs(direction[a]);
  }
  double travelled_m = 0.0;
  while (travelled_m <= length_m) {
    if (!visit(cell)) return travelled_m;
    int axis;
    travelled_m = next.minCoeff(&axis);
    next[axis] += delta[axis];
    cell[axis] += step[axis];
  }
  return length_m;
}

// Distances are kept as squares of half cells: from a cell's centre to the near face of a cell d
// away along an axis it is 2·d − 1 half cells, and the squares of the three axes add up.
constexpr double kSaturation_m = 2.55;

std::int16_t gap_squared(int cells) {
  return static_cast<std::int16_t>(cells == 0 ? 0 : (2 * cells - 1) * (2 * cells - 1));
}

struct Reach {
  int cells;         // away, at which a distance is saturated along one axis
  std::int16_t far;  // the squared distance that stands for all beyond
};
Reach reach_of(double resolution_m) {
  // Coarse enough for 16 bits; a finer map saturates at 60 cells.
  const int cells = std::min(60, static_cast<int>(std::ceil(kSaturation_m / resolution_m + 0.5)));
  return {cells, gap_squared(cells)};
}

// Squared distances along z: up and down, row by row of x.
void sweep_columns(const GridMap& map, bool unknown_too, const Reach& reach,
                   std::vector<std::int16_t>& out) {
  const int layer = map.size.x() * map.size.y(), nz = map.size.z();
  const auto far = static_cast<std::int16_t>(reach.cells);
  const auto free = static_cast<std::uint8_t>(Cell::kFree);
  const auto unknown = static_cast<std::uint8_t>(unknown_too ? Cell::kFree : Cell::kUnknown);
  for (int z = 0; z < nz; ++z) {
    const std::uint8_t* in = map.cells.data() + static_cast<std::size_t>(z) * layer;
    std::int16_t* d = out.data() + static_cast<std::size_t>(z) * layer;
    for (int i = 0; i < layer; ++i) {
      const std::int16_t below = z > 0 ? d[i - layer] : far;
      const auto next = static_cast<std::int16_t>(below < far ? below + 1 : far);
      d[i] = (in[i] == free || in[i] == unknown) ? next : std::int16_t{0};
    }
  }
  for (int z = nz - 2; z >= 0; --z) {
    std::int16_t* d = out.data() + static_cast<std::size_t>(z) * layer;
    for (int i = 0; i < layer; ++i)
      d[i] = std::min<std::int16_t>(d[i], static_cast<std::int16_t>(d[i + layer] + 1));
  }
  for (std::int16_t& d : out) {
    const auto gap = static_cast<std::int16_t>(2 * d - 1);
    d = d == 0 ? std::int16_t{0} : static_cast<std::int16_t>(gap * gap);
  }
}

// Lowers a row to what the rows on both sides, `add` away, allow; returns its greatest value.
std::int16_t lower(std::int16_t* row, const std::int16_t* before, const std::int16_t* after,
                   std::int16_t add, int count) {
  std::int16_t greatest = 0;
  for (int x = 0; x < count; ++x) {
    const auto beside = static_cast<std::int16_t>(std::min(before[x], after[x]) + add);
    row[x] = std::min(row[x], beside);
    greatest = std::max(greatest, row[x]);
  }
  return greatest;
}

// Adds the squares along y to a row: min over o of in[y + o] + gap(o)², outwards until no farther
// row can lower anything.
void spread_along_y(const std::int16_t* source, std::int16_t* target, int y, const Vec3i& size,
                    const Reach& reach) {
  const int nx = size.x(), ny = size.y();
  std::copy_n(source, nx, target);
  std::int16_t greatest = reach.far;
  for (int o = 1; o < reach.cells && gap_squared(o) < greatest; ++o) {
    if (y < o && y + o >= ny) return;
    // At a side of the grid the other neighbour stands for both.
    const std::int16_t* before = source + static_cast<std::ptrdiff_t>(y >= o ? -o : o) * nx;
    const std::int16_t* after = source + static_cast<std::ptrdiff_t>(y + o < ny ? o : -o) * nx;
    greatest = lower(target, before, after, gap_squared(o), nx);
  }
}

// The same along x, in a row. `padded` has `reach` far values on both sides.
void spread_along_x(std::int16_t* row, std::vector<std::int16_t>& padded, int nx,
                    const Reach& reach) {
  std::int16_t* middle = padded.data() + reach.cells;
  std::copy_n(row, nx, middle);
  std::int16_t greatest = reach.far;
  for (int o = 1; o < reach.cells && gap_squared(o) < greatest; ++o)
    greatest = lower(row, middle - o, middle + o, gap_squared(o), nx);
}

void fill_table(double resolution_m, const Reach& reach, std::vector<std::uint8_t>& centimetres) {
  centimetres.resize(static_cast<std::size_t>(reach.far) + 1);
  for (int d2 = 0; d2 <= reach.far; ++d2) {
    const double cm = std::floor(50.0 * resolution_m * std::sqrt(static_cast<double>(d2)));
    centimetres[d2] = static_cast<std::uint8_t>(std::min(255.0, cm));
  }
}

void transform(const GridMap& map, bool unknown_too, const Reach& reach, DistanceWorkspace& w,
               std::vector<std::uint8_t>& out_cm) {
  const int nx = map.size.x(), ny = map.size.y(), nz = map.size.z();
  w.columns.resize(map.cell_count());
  w.row.resize(nx);
  w.padded.assign(static_cast<std::size_t>(nx) + 2 * reach.cells, reach.far);
  out_cm.resize(map.cell_count());
  sweep_columns(map, unknown_too, reach, w.columns);
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y) {
      const std::size_t row = map.offset_of({0, y, z});
      spread_along_y(w.columns.data() + row, w.row.data(), y, map.size, reach);
      spread_along_x(w.row.data(), w.padded, nx, reach);
      for (int x = 0; x < nx; ++x) out_cm[row + x] = w.centimetres[w.row[x]];
    }
}

}  // namespace

void update_distances(GridMap& map, DistanceWorkspace& workspace) {
  if (map.empty()) return;
  const Reach reach = reach_of(map.resolution_m);
  fill_table(map.resolution_m, reach, workspace.centimetres);
  transform(map, false, reach, workspace, map.occupied_distance_cm);
  const auto unknown = static_cast<std::uint8_t>(Cell::kUnknown);
  if (std::find(map.cells.begin(), map.cells.end(), unknown) == map.cells.end())
    map.unfree_distance_cm = map.occupied_distance_cm;
  else
    transform(map, true, reach, workspace, map.unfree_distance_cm);
}

bool line_of_sight(const GridMap& map, const Vec3& from_enu_m, const Vec3& to_enu_m) {
  const Vec3 span = to_enu_m - from_enu_m;
  const double length_m = span.norm();
  if (length_m < 1e-9) return !map.is_occupied(from_enu_m);
  return ray_distance_m(map, from_enu_m, span / length_m, length_m) >= length_m;
}

double ray_distance_m(const GridMap& map, const Vec3& from_enu_m, const Vec3& direction,
                      double range_m) {
  return traverse(map, from_enu_m, direction, range_m, [&](const Eigen::Vector3i& i) {
    return !map.contains(i) ||
           map.cells[map.offset_of(i)] != static_cast<std::uint8_t>(Cell::kOccupied);
  });
}

}  // namespace foretrack
