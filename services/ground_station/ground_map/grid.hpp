// SPDX-License-Identifier: Apache-2.0
// Places on maps: from the grid in which a map is drawn to WGS84.
#pragma once

#include <string_view>

namespace foretrack::station {

struct Wgs84 {
  double lat_deg = 0.0, lon_deg = 0.0;
};

/// In what the coordinates of a map are counted, as EPSG numbers it.
struct Grid {
  int epsg = 4326;
  static constexpr int kWorld = 0;  // metres east and north in the vehicles' world frame
};

/// 4326 and 4258 (longitude, latitude), 3857, UTM (326xx, 327xx, 258xx), or the world frame.
bool is_known(Grid grid);
/// "EPSG:32633", "world". Throws std::invalid_argument which says what is known.
Grid grid_named(std::string_view name);
/// x: east or longitude, y: north or latitude. Throws std::invalid_argument where the grid has no
/// such place. Precondition: known, and not the world frame.
Wgs84 to_wgs84(Grid grid, double x, double y);

}  // namespace foretrack::station
