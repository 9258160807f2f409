// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/ground_map/ground_map.hpp"

#include <fmt/format.h>

#include <cctype>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "services/ground_station/ground_map/load_geotiff.hpp"
#include "services/ground_station/ground_map/load_placed_image.hpp"
#include "services/ground_station/http/files.hpp"

namespace foretrack::station {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMap = "/map/";

std::string lower_extension(const fs::path& file) {
  auto extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

nlohmann::json describe(const MapImage& image) {
  const bool in_world = image.place.grid.epsg == Grid::kWorld;
  return {{"kind", "image"},
          {"frame", in_world ? "world" : "wgs84"},
          {"width_px", image.width_px},
          {"height_px", image.height_px},
          {"corners", corners_of(image)}};
}

nlohmann::json describe(const MapTiles& tiles) {
  return {{"kind", "tiles"}, {"zoom_min", tiles.zoom_min}, {"zoom_max", tiles.zoom_max}};
}

}  // namespace

GroundMap GroundMap::load(const fs::path& path) try {
  GroundMap map;
  map.has_tiles_ = fs::is_directory(path);
  const auto extension = lower_extension(path);
  if (map.has_tiles_) {
    map.tiles_ = find_tiles(path);
  } else if (!fs::is_regular_file(path)) {
    throw std::runtime_error("there is no such file or folder");
  } else if (extension == ".tif" || extension == ".tiff") {
    map.image_ = load_geotiff(path);
  } else {
    map.image_ = load_placed_image(path);
  }
  if (!map.has_tiles_) corners_of(map.image_);  // each is a place
  return map;
} catch (const std::exception& error) {
  throw std::runtime_error(fmt::format("--map {}: {}", path.string(), error.what()));
}

std::array<std::array<double, 2>, 4> corners_of(const MapImage& image) {
  const auto& p = image.place;
  std::array<std::array<double, 2>, 4> corners{};
  constexpr std::array<std::array<int, 2>, 4> kEnds = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double column = kEnds[i][0] * image.width_px, row = kEnds[i][1] * image.height_px;
    const double x = p.x + column * p.column_x + row * p.row_x;
    const double y = p.y + column * p.column_y + row * p.row_y;
    if (p.grid.epsg == Grid::kWorld) {
      corners[i] = {x, y};
      continue;
    }
    const auto place = to_wgs84(p.grid, x, y);
    corners[i] = {place.lon_deg, place.lat_deg};
  }
  return corners;
}

std::string GroundMap::description() const {
  return (has_tiles_ ? describe(tiles_) : describe(image_)).dump();
}

Response GroundMap::answer(const Request& request) const {
  if (request.path == "/map.json") return json_response(200, description());
  const auto name = std::string_view(request.path).substr(kMap.size() - 1);
  if (has_tiles_)
    return serve_file(tiles_.folder, std::string(name) + tiles_.extension, request.range, false);
  if (name != "/image") return text_response(404, "there is no such map");
  if (!image_.file.empty())
    return serve_file(image_.file.parent_path(), '/' + image_.file.filename().string(),
                      request.range, false);
  Response response;
  response.type = image_.type;
  response.body.assign(image_.encoded.begin(), image_.encoded.end());
  return response;
}

}  // namespace foretrack::station
