// SPDX-License-Identifier: Apache-2.0
#include "services/convert/map.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/mapping/octree_io.hpp"
#include "services/convert/geometry.hpp"

namespace foretrack {
namespace {

namespace cells = foretrack_msgs::msg::LocalMap_Constants;
static_assert(cells::CELL_FREE == int(Cell::kFree));
static_assert(cells::CELL_OCCUPIED == int(Cell::kOccupied));
static_assert(cells::CELL_UNKNOWN == int(Cell::kUnknown));

void set_point_fields(sensor_msgs::msg::PointCloud2& out) {
  out.fields().resize(3);
  for (std::uint32_t i = 0; i < 3; ++i) {
    out.fields()[i].name(std::string(1, "xyz"[i]));
    out.fields()[i].offset(i * sizeof(float));
    out.fields()[i].datatype(sensor_msgs::msg::PointField_Constants::FLOAT32);
    out.fields()[i].count(1);
  }
  out.point_step(3 * sizeof(float));
  out.is_dense(true);
}

}  // namespace

void to_idl(const GridMap& in, foretrack_msgs::msg::LocalMap& out) {
  if (in.cells.size() > cells::MAX_CELLS) throw std::length_error("LocalMap.cells: above 4000000");
  set_header(out.header(), in.stamp_s);
  out.resolution_m(in.resolution_m);
  out.origin_m(to_array(in.origin_enu_m));
  out.size_x(in.size.x());
  out.size_y(in.size.y());
  out.size_z(in.size.z());
  out.cells().assign(in.cells.begin(), in.cells.end());
  out.occupied_distance_cm().assign(in.occupied_distance_cm.begin(), in.occupied_distance_cm.end());
  out.unfree_distance_cm().assign(in.unfree_distance_cm.begin(), in.unfree_distance_cm.end());
}

Converted<GridMap> from_idl(foretrack_msgs::msg::LocalMap in) {
  Checks checks;
  check_header(checks, in.header());
  checks.in_range("resolution_m", in.resolution_m(), 0.01, 10.0);
  checks.within("origin_m", in.origin_m(), limits::kPosition_m);
  checks.in_range("size_x", in.size_x(), 1, cells::MAX_CELLS);
  checks.in_range("size_y", in.size_y(), 1, cells::MAX_CELLS);
  checks.in_range("size_z", in.size_z(), 1, cells::MAX_CELLS);
  const double product = static_cast<double>(in.size_x()) * in.size_y() * in.size_z();
  checks.in_range("size", product, 1, cells::MAX_CELLS);
  if (!checks.ok()) return checks.result(GridMap());
  const auto count = static_cast<std::size_t>(product);
  checks.count("cells", in.cells().size(), count, count);
  checks.count("occupied_distance_cm", in.occupied_distance_cm().size(), count, count);
  checks.count("unfree_distance_cm", in.unfree_distance_cm().size(), count, count);
  if (!checks.ok()) return checks.result(GridMap());
  const auto largest = *std::max_element(in.cells().begin(), in.cells().end());
  checks.enumerator("cells", largest, cells::CELL_UNKNOWN);
  GridMap out;
  out.stamp_s = seconds(in.header().stamp());
  out.resolution_m = in.resolution_m();
  out.origin_enu_m = to_vec3(in.origin_m());
  out.size = Eigen::Vector3i(in.size_x(), in.size_y(), in.size_z());
  out.cells = std::move(in.cells());
  out.occupied_distance_cm = std::move(in.occupied_distance_cm());
  out.unfree_distance_cm = std::move(in.unfree_distance_cm());
  return checks.result(std::move(out));
}

void to_points(const GridMap& map, sensor_msgs::msg::PointCloud2& out) {
  set_header(out.header(), map.stamp_s);
  set_point_fields(out);
  out.data().clear();
  for (int z = 0; z < map.size.z(); ++z)
    for (int y = 0; y < map.size.y(); ++y)
      for (int x = 0; x < map.size.x(); ++x) {
        const Eigen::Vector3i cell(x, y, z);
        if (map.cells[map.offset_of(cell)] != cells::CELL_OCCUPIED) continue;
        const auto point = to_floats(map.center_of(cell));
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(point.data());
        out.data().insert(out.data().end(), bytes, bytes + sizeof point);
      }
  out.height(1);
  out.row_step(static_cast<std::uint32_t>(out.data().size()));
  out.width(out.row_step() / out.point_step());
}

void to_idl(const octomap::OcTree& tree, double stamp_s, octomap_msgs::msg::Octomap& out) {
  const std::string bytes = octree_bytes(tree);
  set_header(out.header(), stamp_s);
  out.binary(true);
  out.id(tree.getTreeType());
  out.resolution(tree.getResolution());
  out.data().assign(bytes.begin(), bytes.end());
}

}  // namespace foretrack
