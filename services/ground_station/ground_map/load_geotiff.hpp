// SPDX-License-Identifier: Apache-2.0
// A GeoTIFF: its pixels, and the few of its tags that tell where they lie (OGC GeoTIFF 1.1).
#pragma once

#include "services/ground_station/ground_map/map_image.hpp"

namespace foretrack::station {

/// As JPEG; a side of more than kMostMapSide_px is thinned. Throws std::runtime_error that says
/// what was expected.
MapImage load_geotiff(const std::filesystem::path& file);

}  // namespace foretrack::station
