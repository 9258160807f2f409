// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/ground_map/load_geotiff.hpp"

#include <fmt/format.h>
#include <tiffio.h>

#include <algorithm>
#include <memory>
#include <span>
#include <stdexcept>

#include "services/convert/encode_jpeg.hpp"

namespace foretrack::station {
namespace {

constexpr ttag_t kPixelScale = 33550, kTiePoint = 33922, kTransformation = 34264, kGeoKeys = 34735;
constexpr int kRasterType = 1025, kGeographicType = 2048, kProjectedType = 3072;
constexpr int kPixelIsPoint = 2;
constexpr int kJpegQuality = 88;
constexpr std::uint64_t kMostPixels = 64u << 20;

using Tiff = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

// Tags that the library does not know come as a count and the values.
template <typename T>
std::span<const T> tag(TIFF* tiff, ttag_t id) {
  std::uint16_t count = 0;
  const T* values = nullptr;
  if (TIFFGetField(tiff, id, &count, &values) != 1 || values == nullptr) return {};
  return {values, count};
}

// Key, where its value is (0: here), how many, the value; after a head of four.
int geo_key(std::span<const std::uint16_t> keys, int wanted) {
  for (std::size_t i = 4; i + 3 < keys.size(); i += 4)
    if (keys[i] == wanted && keys[i + 1] == 0) return keys[i + 3];
  return 0;
}

Grid grid_of(std::span<const std::uint16_t> keys) {
  const int projected = geo_key(keys, kProjectedType);
  const Grid grid{projected != 0 ? projected : geo_key(keys, kGeographicType)};
  if (grid.epsg != Grid::kWorld && is_known(grid)) return grid;
  throw std::runtime_error(fmt::format(
      "its grid is EPSG:{}: 4326, 4258, 3857 or a UTM zone expected (gdalwarp -t_srs EPSG:4326)",
      grid.epsg));
}

ImagePlace place_of(TIFF* tiff) {
  ImagePlace place;
  const auto scale = tag<double>(tiff, kPixelScale), tie = tag<double>(tiff, kTiePoint);
  const auto matrix = tag<double>(tiff, kTransformation);
  if (matrix.size() == 16) {
    place.column_x = matrix[0], place.row_x = matrix[1], place.x = matrix[3];
    place.column_y = matrix[4], place.row_y = matrix[5], place.y = matrix[7];
  } else if (scale.size() >= 2 && tie.size() >= 6) {
    place.column_x = scale[0], place.row_y = -scale[1];
    place.x = tie[3] - tie[0] * scale[0];
    place.y = tie[4] + tie[1] * scale[1];
  } else {
    throw std::runtime_error("a TIFF without the tags that say where it lies (a GeoTIFF expected)");
  }
  const auto keys = tag<std::uint16_t>(tiff, kGeoKeys);
  place.grid = grid_of(keys);
  if (geo_key(keys, kRasterType) == kPixelIsPoint) {  // of the first pixel's middle
    place.x -= 0.5 * (place.column_x + place.row_x);
    place.y -= 0.5 * (place.column_y + place.row_y);
  }
  return place;
}

// Every so many pixels of each, so that a side is no longer than can be drawn.
RgbImage thinned(std::span<const std::uint32_t> rgba, int width, int height, int step) {
  RgbImage image{width / step, height / step, {}};
  image.rgb.resize(3u * static_cast<std::size_t>(image.width_px) * image.height_px);
  for (int row = 0; row < image.height_px; ++row)
    for (int column = 0; column < image.width_px; ++column) {
      const auto value = rgba[static_cast<std::size_t>(row) * step * width + column * step];
      auto* pixel = image.pixel(column, row);
      pixel[0] = TIFFGetR(value), pixel[1] = TIFFGetG(value), pixel[2] = TIFFGetB(value);
    }
  return image;
}

}  // namespace

MapImage load_geotiff(const std::filesystem::path& file) {
  TIFFSetWarningHandler(nullptr);  // of tags that it does not know, which are those
  TIFFSetErrorHandler(nullptr);    // what fails is told below
  const Tiff tiff(TIFFOpen(file.c_str(), "r"), &TIFFClose);
  if (!tiff) throw std::runtime_error("no TIFF, or cut off");
  std::uint32_t width = 0, height = 0;
  TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &height);
  const std::uint64_t count = std::uint64_t{width} * height;
  if (count == 0 || count > kMostPixels)
    throw std::runtime_error(
        fmt::format("{} × {} pixels, {} million at most expected (gdal_translate "
                    "-outsize, or gdal2tiles for a folder of tiles)",
                    width, height, kMostPixels >> 20));
  MapImage image;
  image.place = place_of(tiff.get());
  std::vector<std::uint32_t> rgba(count);
  if (TIFFReadRGBAImageOriented(tiff.get(), width, height, rgba.data(), ORIENTATION_TOPLEFT, 1) !=
      1)
    throw std::runtime_error(
        "its pixels cannot be read: eight bits a colour expected, all of them");
  const int step = (static_cast<int>(std::max(width, height)) - 1) / kMostMapSide_px + 1;
  const auto pixels = thinned(rgba, static_cast<int>(width), static_cast<int>(height), step);
  encode_jpeg(pixels, kJpegQuality, image.encoded);
  image.type = "image/jpeg";
  image.width_px = pixels.width_px, image.height_px = pixels.height_px;
  image.place.column_x *= step, image.place.column_y *= step;
  image.place.row_x *= step, image.place.row_y *= step;
  return image;
}

}  // namespace foretrack::station
