// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/ground_map/find_tiles.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <stdexcept>

namespace foretrack::station {
namespace {

namespace fs = std::filesystem;

constexpr int kMostZoom = 24;

std::optional<int> number_of(const fs::path& name) {
  const auto text = name.string();
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 0) return std::nullopt;
  return value;
}

// Of any tile of this zoom: "12/2148/1434.png".
std::string extension_in(const fs::path& zoom_folder) {
  for (const auto& column : fs::directory_iterator(zoom_folder)) {
    if (!column.is_directory() || !number_of(column.path().filename())) continue;
    for (const auto& tile : fs::directory_iterator(column)) {
      const auto extension = tile.path().extension().string();
      if (number_of(tile.path().stem()) && (extension == ".png" || extension == ".jpg"))
        return extension;
    }
  }
  return {};
}

}  // namespace

MapTiles find_tiles(const fs::path& folder) {
  MapTiles tiles{folder, {}, kMostZoom + 1, -1};
  for (const auto& entry : fs::directory_iterator(folder)) {
    const auto zoom = number_of(entry.path().filename());
    if (!entry.is_directory() || !zoom || *zoom > kMostZoom) continue;
    const auto extension = extension_in(entry.path());
    if (extension.empty()) continue;
    if (!tiles.extension.empty() && extension != tiles.extension)
      throw std::runtime_error("some tiles are " + tiles.extension + " and some are " + extension +
                               ": one kind expected");
    tiles.extension = extension;
    tiles.zoom_min = std::min(tiles.zoom_min, *zoom);
    tiles.zoom_max = std::max(tiles.zoom_max, *zoom);
  }
  if (tiles.zoom_max < 0)
    throw std::runtime_error("there are no tiles in it: zoom/x/y.png or zoom/x/y.jpg expected");
  return tiles;
}

}  // namespace foretrack::station
