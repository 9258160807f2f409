// SPDX-License-Identifier: Apache-2.0
// What lies under the map of the page: tiles, or one image whose corners are known. Optional, and
// from this machine.
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "services/ground_station/ground_map/find_tiles.hpp"
#include "services/ground_station/ground_map/map_image.hpp"
#include "services/ground_station/http/message.hpp"

namespace foretrack::station {

class GroundMap {
 public:
  /// A folder of tiles, a PNG or JPEG with a world file or corners in YAML beside it, or a GeoTIFF.
  /// Throws std::runtime_error that names the file and what was expected.
  static GroundMap load(const std::filesystem::path& path);

  /// For pages: as docs/ground_station.md has it.
  std::string description() const;
  /// GET /map.json, /map/image, /map/z/x/y: 404 for what is not there.
  Response answer(const Request& request) const;

 private:
  MapImage image_;
  MapTiles tiles_;
  bool has_tiles_ = false;
};

/// Upper left, upper right, lower right, lower left: x and y, or longitude and latitude.
std::array<std::array<double, 2>, 4> corners_of(const MapImage& image);

}  // namespace foretrack::station
