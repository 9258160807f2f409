// SPDX-License-Identifier: Apache-2.0
#include "services/files/config/load_bounds.hpp"

#include <fmt/format.h>

#include "services/files/yaml/yaml_reader.hpp"

namespace foretrack {
namespace {

constexpr double kFarthest_m = 1.0e5;

void read_fence(YamlReader& reader, FlightBounds& bounds) {
  std::vector<Vec2> corners;
  reader.points("fence_m", corners);
  if (corners.size() > FlightBounds::kMaxCorners)
    return reader.fault("fence_m", fmt::format("has {} corners, expected {} at most",
                                               corners.size(), FlightBounds::kMaxCorners));
  for (const Vec2& corner : corners)
    bounds.corners_enu_m[bounds.corner_count++] = {corner.x(), corner.y()};
}

}  // namespace

FlightBounds load_bounds(const std::filesystem::path& file) {
  Faults faults(file.string());
  YamlReader reader(load_yaml(file), "", faults);
  FlightBounds bounds;
  read_fence(reader, bounds);
  reader.number("altitude_min_m", bounds.altitude_min_m, -kFarthest_m, kFarthest_m);
  reader.number("altitude_max_m", bounds.altitude_max_m, -kFarthest_m, kFarthest_m);
  if (!reader.has("fence_m") && bounds == FlightBounds{})
    reader.fault("fence_m", "is missing, and so are the altitudes: nothing is bounded");
  if (!(bounds.altitude_min_m < bounds.altitude_max_m))
    reader.fault("altitude_max_m", "is not above altitude_min_m");
  else if (faults.empty() && !are_valid(bounds))
    reader.fault("fence_m", "is no fence: three corners or more, and edges that do not cross");
  reader.finish();
  faults.throw_if_any();
  return bounds;
}

}  // namespace foretrack
