#include "core/common/grid_map.hpp"

#include <algorithm>
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

constexpr std::uint16_t kFar = 60;  // cells; beyond the saturation at any useful resolution

// Distance along x to the nearest source in each row, in cells.
void sweep_rows(const GridMap& map, std::uint8_t highest_free, std::vector<std::uint16_t>& out) {
  const int nx = map.size.x();
  const std::size_t rows = map.cell_count() / static_cast<std::size_t>(nx);
  for (std::size_t r = 0; r < rows; ++r) {
    const std::uint8_t* in = map.cells.data() + r * nx;
    std::uint16_t* d = out.data() + r * nx;
    const auto is_source = [&](int x) {
      return highest_free == 0 ? in[x] != 0 : in[x] == static_cast<std::uint8_t>(Cell::kOccupied);
    };
    std::uint16_t run = kFar;
    for (int x = 0; x < nx; ++x) {
      run = is_source(x) ? 0 : static_cast<std::uint16_t>(std::min<int>(run + 1, kFar));
      d[x] = run;
    }
    run = kFar;
    for (int x = nx - 1; x >= 0; --x) {
      run = d[x] == 0 ? 0 : static_cast<std::uint16_t>(std::min<int>(run + 1, kFar));
      d[x] = std::min(d[x], run);
    }
    for (int x = 0; x < nx; ++x) d[x] = static_cast<std::uint16_t>(d[x] * d[x]);
  }
}

// Squared distances along one more axis: min over o within `reach` cells of in[i + o·stride] + o².
// Row by row of x, so that the inner loop is a vector of minima.
void spread(const std::vector<std::uint16_t>& in, std::vector<std::uint16_t>& out,
            const GridMap& map, int axis, int reach) {
  const int nx = map.size.x(), ny = map.size.y(), nz = map.size.z();
  const int count = axis == 1 ? ny : nz;
  const std::size_t stride = axis == 1 ? nx : static_cast<std::size_t>(nx) * ny;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y) {
      const std::size_t row = (static_cast<std::size_t>(z) * ny + y) * nx;
      const int here = axis == 1 ? y : z;
      std::copy_n(in.begin() + row, nx, out.begin() + row);
      const int low = std::max(-reach, -here), high = std::min(reach, count - 1 - here);
      for (int o = low; o <= high; ++o) {
        if (o == 0) continue;
        const std::uint16_t* src = in.data() + row + static_cast<std::ptrdiff_t>(o) * stride;
        std::uint16_t* dst = out.data() + row;
        const auto add = static_cast<std::uint16_t>(o * o);
        for (int x = 0; x < nx; ++x)
          dst[x] = std::min<std::uint16_t>(dst[x], static_cast<std::uint16_t>(src[x] + add));
      }
    }
}

void transform(const GridMap& map, std::uint8_t highest_free, DistanceWorkspace& w,
               std::vector<std::uint8_t>& out_cm) {
  const int reach = std::min<int>(kFar - 1, static_cast<int>(2.55 / map.resolution_m) + 1);
  w.a.resize(map.cell_count());
  w.b.resize(map.cell_count());
  out_cm.resize(map.cell_count());
  sweep_rows(map, highest_free, w.a);
  spread(w.a, w.b, map, 1, reach);
  spread(w.b, w.a, map, 2, reach);
  std::uint8_t centimetres[4 * kFar * kFar];
  for (int d2 = 0; d2 < 4 * kFar * kFar; ++d2) {
    const double d_m =
        d2 == 0 ? 0.0 : (std::sqrt(static_cast<double>(d2)) - 0.5) * map.resolution_m;
    centimetres[d2] = static_cast<std::uint8_t>(std::min(255.0, std::floor(100.0 * d_m)));
  }
  for (std::size_t i = 0; i < out_cm.size(); ++i) out_cm[i] = centimetres[w.a[i]];
}

}  // namespace

void update_distances(GridMap& map, DistanceWorkspace& workspace) {
  if (map.empty()) return;
  transform(map, 1, workspace, map.occupied_distance_cm);
  const auto unknown = static_cast<std::uint8_t>(Cell::kUnknown);
  if (std::find(map.cells.begin(), map.cells.end(), unknown) == map.cells.end())
    map.unfree_distance_cm = map.occupied_distance_cm;
  else
    transform(map, 0, workspace, map.unfree_distance_cm);
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
