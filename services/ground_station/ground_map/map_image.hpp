// SPDX-License-Identifier: Apache-2.0
// One image under the map, and where it lies.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "services/ground_station/ground_map/grid.hpp"

namespace foretrack::station {

/// Places of an image on its grid, of pixels' corners.
struct ImagePlace {
  Grid grid;
  double x = 0.0, y = 0.0;                // of the image's upper left corner
  double column_x = 0.0, column_y = 0.0;  // from a column to the next
  double row_x = 0.0, row_y = 0.0;        // from a row to the next
};

struct MapImage {
  std::filesystem::path file;         // served as it is; empty: what is encoded below
  std::string type;                   // "image/png"
  std::vector<std::uint8_t> encoded;  // "image/jpeg"
  int width_px = 0, height_px = 0;
  ImagePlace place;
};

/// The largest side of an image that browsers and graphics libraries draw.
inline constexpr int kMostMapSide_px = 8192;

}  // namespace foretrack::station
