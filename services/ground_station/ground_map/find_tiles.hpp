// SPDX-License-Identifier: Apache-2.0
// A folder of map tiles.
#pragma once

#include <filesystem>
#include <string>

namespace foretrack::station {

/// Web Mercator, XYZ: zoom/x/y.png or .jpg, y from the north.
struct MapTiles {
  std::filesystem::path folder;
  std::string extension;  // ".png"
  int zoom_min = 0, zoom_max = 0;
};

/// Throws std::runtime_error if there are none, or of both kinds.
MapTiles find_tiles(const std::filesystem::path& folder);

}  // namespace foretrack::station
