// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/ground_map/load_placed_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "services/files/yaml/yaml_reader.hpp"

namespace foretrack::station {
namespace {

namespace fs = std::filesystem;

constexpr double kFarthest = 1.0e8;  // of a coordinate on any grid
constexpr std::size_t kHeadBytes = 1 << 20;

using Head = std::vector<std::uint8_t>;

int big_endian(const Head& head, std::size_t at, std::size_t bytes) {
  int value = 0;
  for (std::size_t i = 0; i < bytes; ++i) value = (value << 8) | head[at + i];
  return value;
}

// The first chunk of a PNG is its header.
bool read_png_size(const Head& head, MapImage& image) {
  constexpr std::array<std::uint8_t, 8> kSignature = {0x89, 'P', 'N', 'G', 13, 10, 26, 10};
  if (head.size() < 24 || !std::equal(kSignature.begin(), kSignature.end(), head.begin()))
    return false;
  image.type = "image/png";
  image.width_px = big_endian(head, 16, 4);
  image.height_px = big_endian(head, 20, 4);
  return true;
}

// The segment that starts a frame, whichever of its kinds; 0xc4, 0xc8 and 0xcc are others.
bool read_jpeg_size(const Head& head, MapImage& image) {
  if (head.size() < 4 || head[0] != 0xff || head[1] != 0xd8) return false;
  for (std::size_t at = 2; at + 9 < head.size() && head[at] == 0xff;
       at += 2 + static_cast<std::size_t>(big_endian(head, at + 2, 2))) {
    const auto kind = head[at + 1];
    const bool is_frame =
        kind >= 0xc0 && kind <= 0xcf && kind != 0xc4 && kind != 0xc8 && kind != 0xcc;
    if (!is_frame) continue;
    image.type = "image/jpeg";
    image.height_px = big_endian(head, at + 5, 2);
    image.width_px = big_endian(head, at + 7, 2);
    return true;
  }
  return false;
}

void read_size(const fs::path& file, MapImage& image) {
  std::ifstream stream(file, std::ios::binary);
  Head head(kHeadBytes);
  stream.read(reinterpret_cast<char*>(head.data()), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(stream.gcount()));
  if (!read_png_size(head, image) && !read_jpeg_size(head, image))
    throw std::runtime_error(
        "neither a PNG nor a JPEG, nor a .tif: one of them, or a folder of "
        "tiles, expected");
  if (image.width_px < 1 || image.height_px < 1 || image.width_px > kMostMapSide_px ||
      image.height_px > kMostMapSide_px)
    throw std::runtime_error(fmt::format("{} × {} pixels, {} a side at most expected",
                                         image.width_px, image.height_px, kMostMapSide_px));
}

fs::path beside(const fs::path& file, const char* extension) {
  return fs::path(file).replace_extension(extension);
}

// Six numbers: the steps of a column and a row, and the middle of the first pixel.
std::optional<ImagePlace> read_world_file(const fs::path& file) {
  for (const char* extension : {".pgw", ".jgw", ".wld"}) {
    const auto path = beside(file, extension);
    std::ifstream stream(path);
    if (!stream) continue;
    ImagePlace place;
    double middle_x = 0.0, middle_y = 0.0;
    stream >> place.column_x >> place.column_y >> place.row_x >> place.row_y >> middle_x >>
        middle_y;
    const double area = place.column_x * place.row_y - place.column_y * place.row_x;
    if (!stream || !(std::abs(area) > 0.0))
      throw std::runtime_error(path.string() + ": six numbers of a world file expected");
    place.x = middle_x - 0.5 * (place.column_x + place.row_x);
    place.y = middle_y - 0.5 * (place.column_y + place.row_y);
    return place;
  }
  return std::nullopt;
}

ImagePlace read_corners(YamlReader& reader, const MapImage& image) {
  double west = NAN, south = NAN, east = NAN, north = NAN;
  reader.number("west", west, -kFarthest, kFarthest);
  reader.number("south", south, -kFarthest, kFarthest);
  reader.number("east", east, -kFarthest, kFarthest);
  reader.number("north", north, -kFarthest, kFarthest);
  if (!(west < east)) reader.fault("east", "is not east of west, or one of them is missing");
  if (!(south < north)) reader.fault("north", "is not north of south, or one of them is missing");
  ImagePlace place;
  place.x = west, place.y = north;
  place.column_x = (east - west) / image.width_px;
  place.row_y = (south - north) / image.height_px;
  return place;
}

Grid read_grid(YamlReader& reader) {
  std::string name;
  reader.text("crs", name);
  try {
    return grid_named(name);
  } catch (const std::invalid_argument& error) {
    reader.fault("crs", error.what());
    return {};
  }
}

bool looks_like_degrees(const ImagePlace& place) {
  return std::abs(place.x) <= 180.0 && std::abs(place.y) <= 90.0 &&
         std::abs(place.column_x) < 0.1 && std::abs(place.row_y) < 0.1;
}

}  // namespace

MapImage load_placed_image(const fs::path& file) {
  MapImage image;
  image.file = fs::absolute(file);
  read_size(file, image);
  const auto yaml = beside(file, ".yaml");
  const auto world = read_world_file(file);
  if (world) image.place = *world;
  if (fs::exists(yaml)) {
    Faults faults(yaml.string());
    YamlReader reader(load_yaml(yaml), "", faults);
    const auto grid = read_grid(reader);
    if (!world) image.place = read_corners(reader, image);
    image.place.grid = grid;
    reader.finish();
    faults.throw_if_any();
  } else if (!world) {
    throw std::runtime_error("where it lies is not known: a world file (.pgw, .jgw, .wld) or " +
                             yaml.string() + " with crs, west, south, east and north expected");
  } else if (!looks_like_degrees(*world)) {
    throw std::runtime_error("its world file is not in degrees: " + yaml.string() +
                             " with its grid, as in \"crs: EPSG:32633\", expected");
  }
  return image;
}

}  // namespace foretrack::station
