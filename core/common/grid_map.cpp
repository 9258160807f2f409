#include "core/common/grid_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace foretrack {
namespace {

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

// Squared distances along x.
void sweep_rows(const GridMap& map, bool unknown_too, const Reach& reach,
                std::vector<std::int16_t>& out) {
  const int nx = map.size.x();
  std::array<std::int16_t, 64> squares;
  for (int d = 0; d <= reach.cells; ++d) squares[d] = gap_squared(d);
  const std::size_t row_count = map.cell_count() / static_cast<std::size_t>(nx);
  for (std::size_t r = 0; r < row_count; ++r) {
    const std::uint8_t* in = map.cells.data() + r * nx;
    std::int16_t* d = out.data() + r * nx;
    const auto is_source = [&](int x) {
      return unknown_too ? in[x] != 0 : in[x] == static_cast<std::uint8_t>(Cell::kOccupied);
    };
    int run = reach.cells;
    for (int x = 0; x < nx; ++x) {
      run = is_source(x) ? 0 : std::min(run + 1, reach.cells);
      d[x] = static_cast<std::int16_t>(run);
    }
    for (int x = nx - 1; x >= 0; --x) {
      run = std::min<int>(d[x], std::min(run + 1, reach.cells));
      d[x] = squares[run];
    }
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

// Squared distances along one more axis: min over o of in[i + o·stride] + gap(o)², row by row of x,
// outwards until no farther row can lower anything.
void spread(const std::vector<std::int16_t>& in, std::vector<std::int16_t>& out, const GridMap& map,
            int axis, const Reach& reach) {
  const int nx = map.size.x(), ny = map.size.y(), nz = map.size.z();
  const int count = axis == 1 ? ny : nz;
  const std::ptrdiff_t stride = axis == 1 ? nx : static_cast<std::ptrdiff_t>(nx) * ny;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y) {
      const std::ptrdiff_t row = (static_cast<std::ptrdiff_t>(z) * ny + y) * nx;
      const int here = axis == 1 ? y : z;
      const std::int16_t* source = in.data() + row;
      std::int16_t* target = out.data() + row;
      std::copy_n(source, nx, target);
      std::int16_t greatest = reach.far;
      for (int o = 1; o < reach.cells && gap_squared(o) < greatest; ++o) {
        if (here < o && here + o >= count) break;
        // At a side of the grid the other neighbour stands for both.
        const std::int16_t* before = source + (here >= o ? -o : o) * stride;
        const std::int16_t* after = source + (here + o < count ? o : -o) * stride;
        greatest = lower(target, before, after, gap_squared(o), nx);
      }
    }
}

void transform(const GridMap& map, bool unknown_too, DistanceWorkspace& w,
               std::vector<std::uint8_t>& out_cm) {
  const Reach reach = reach_of(map.resolution_m);
  w.a.resize(map.cell_count());
  w.b.resize(map.cell_count());
  out_cm.resize(map.cell_count());
  sweep_rows(map, unknown_too, reach, w.a);
  spread(w.a, w.b, map, 1, reach);
  spread(w.b, w.a, map, 2, reach);
  w.centimetres.resize(reach.far + 1);
  for (int d2 = 0; d2 <= reach.far; ++d2) {
    const double cm = std::floor(50.0 * map.resolution_m * std::sqrt(static_cast<double>(d2)));
    w.centimetres[d2] = static_cast<std::uint8_t>(std::min(255.0, cm));
  }
  for (std::size_t i = 0; i < out_cm.size(); ++i) out_cm[i] = w.centimetres[w.a[i]];
}

}  // namespace

void update_distances(GridMap& map, DistanceWorkspace& workspace) {
  if (map.empty()) return;
  transform(map, false, workspace, map.occupied_distance_cm);
  const auto unknown = static_cast<std::uint8_t>(Cell::kUnknown);
  if (std::find(map.cells.begin(), map.cells.end(), unknown) == map.cells.end())
    map.unfree_distance_cm = map.occupied_distance_cm;
  else
    transform(map, true, workspace, map.unfree_distance_cm);
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
