// SPDX-License-Identifier: Apache-2.0
// A PNG or JPEG with what stands beside it: a world file (.pgw, .jgw, .wld) or corners, in
// NAME.yaml:
//
//   crs: EPSG:32633      # of the numbers below or of the world file; "world": the vehicles' own
//   frame west: 385100         # without a world file: the image's edges, with north up south:
//   5820050 east: 385400 north: 5820300
#pragma once

#include "services/ground_station/ground_map/map_image.hpp"

namespace foretrack::station {

/// Throws std::exception that says what was expected, and of what stands in a file, in which line.
MapImage load_placed_image(const std::filesystem::path& file);

}  // namespace foretrack::station
