// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/find_movers.hpp"

#include <algorithm>
#include <numbers>

namespace foretrack {
namespace {

using Column = MoverColumns::Column;

constexpr int kLeastReturns = 2;         // of a column
constexpr int kLeastClusterReturns = 8;  // of a body
constexpr double kLeastRadius_m = 0.2;   // half of a body may be seen

bool is_high(const Column& column, const MappingParams& params) {
  return column.count >= kLeastReturns && column.high_m - column.low_m >= params.mover_height_m;
}

void join(Column& to, const Column& from) {
  to.low_m = to.count == 0 ? from.low_m : std::min(to.low_m, from.low_m);
  to.high_m = to.count == 0 ? from.high_m : std::max(to.high_m, from.high_m);
  to.count += from.count;
  to.sum_m += from.sum_m;
  to.sum_squares_m2 += from.sum_squares_m2;
}

// Everything that is high and touches the column, itself too.
Column cluster_at(MoverColumns& movers, const GridMap& map, std::uint32_t start,
                  const MappingParams& params) {
  const int nx = map.size.x(), ny = map.size.y();
  Column all;
  movers.stack.assign(1, start);
  movers.columns[start].visited = true;
  while (!movers.stack.empty()) {
    const int at = static_cast<int>(movers.stack.back());
    movers.stack.pop_back();
    join(all, movers.columns[at]);
    const int x = at % nx, y = at / nx;
    for (int v = std::max(0, y - 1); v <= std::min(ny - 1, y + 1); ++v)
      for (int u = std::max(0, x - 1); u <= std::min(nx - 1, x + 1); ++u) {
        Column& next = movers.columns[v * nx + u];
        if (next.visited || !is_high(next, params)) continue;
        next.visited = true;
        movers.stack.push_back(static_cast<std::uint32_t>(v * nx + u));
      }
  }
  return all;
}

BodySighting body_of(const Column& cluster, const GridMap& map, const Vec3& eye_enu_m,
                     const MappingParams& params) {
  const Vec2 mean_m = cluster.sum_m / cluster.count;
  const Mat2 spread_m2 = cluster.sum_squares_m2 / cluster.count - mean_m * mean_m.transpose();
  const Vec2 face_m = mean_m + map.origin_enu_m.head<2>();
  const Vec2 sight = (face_m - eye_enu_m.head<2>()).normalized();
  const Vec2 across(-sight.y(), sight.x());
  BodySighting body;
  body.kind = BodyKind::kUnknown;
  body.radius_m =
      std::max(kLeastRadius_m, std::sqrt(3.0 * std::max(0.0, across.dot(spread_m2 * across))));
  body.position_enu_m << face_m + std::numbers::pi / 4.0 * body.radius_m * sight, cluster.low_m;
  body.height_m = cluster.high_m - cluster.low_m;
  body.covariance_m2 = params.mover_sigma_m * params.mover_sigma_m * Mat2::Identity();
  return body;
}

}  // namespace

void add_return(MoverColumns& movers, const GridMap& map, const Vec3& point_enu_m) {
  const Eigen::Vector3i cell = map.index_of(point_enu_m);
  const auto at = static_cast<std::uint32_t>(cell.y() * map.size.x() + cell.x());
  Column& column = movers.columns[at];
  if (column.count == 0) movers.touched.push_back(at);
  const Vec2 place_m = (point_enu_m - map.origin_enu_m).head<2>();
  const auto height_m = static_cast<float>(point_enu_m.z());
  join(column, {1, height_m, height_m, place_m, place_m * place_m.transpose()});
}

void find_movers(MoverColumns& movers, const GridMap& map, const Vec3& eye_enu_m,
                 const MappingParams& params, BodySightings& out) {
  out.count = 0;
  for (const std::uint32_t at : movers.touched) {
    const Column& column = movers.columns[at];
    if (column.visited || !is_high(column, params)) continue;
    const Column cluster = cluster_at(movers, map, at, params);
    if (cluster.count < kLeastClusterReturns) continue;
    const BodySighting body = body_of(cluster, map, eye_enu_m, params);
    if (body.radius_m <= params.mover_radius_m) out.add(body);
  }
  for (const std::uint32_t at : movers.touched) movers.columns[at] = {};
  movers.touched.clear();
}

}  // namespace foretrack
