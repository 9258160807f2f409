// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/ground_map/ground_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiffio.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

namespace foretrack::station {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class GroundMapFiles : public ::testing::Test {
 protected:
  GroundMapFiles()
      : folder_(fs::temp_directory_path() / ("ground_map_" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~GroundMapFiles() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) {
    const auto path = folder_ / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  // Its header, which is all that the station reads of it.
  fs::path png(const std::string& name, char width, char height) {
    std::string bytes("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
    bytes += {0, 0, 0, width, 0, 0, 0, height};
    return write(name, bytes + "…");
  }
  std::string fault(const fs::path& path) {
    try {
      GroundMap::load(path);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
  Response get(const GroundMap& map, const std::string& path) {
    Request request;
    request.path = path;
    return map.answer(request);
  }
  nlohmann::json described(const fs::path& path) {
    return nlohmann::json::parse(GroundMap::load(path).description());
  }

  fs::path folder_;
};

// The tags that a GeoTIFF has beside those of a TIFF.
const TIFFFieldInfo kGeoTags[] = {
    {33550, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, const_cast<char*>("ModelPixelScale")},
    {33922, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, const_cast<char*>("ModelTiepoint")},
    {34735, -1, -1, TIFF_SHORT, FIELD_CUSTOM, 1, 1, const_cast<char*>("GeoKeyDirectory")}};

struct TiffKind {
  std::uint16_t epsg_key = 3072, epsg = 32633, raster = 1;
  std::uint32_t width = 4, height = 2;
};

// Red on the left half, green on the right; half a metre a pixel, upper left at 500000, 5820000.
void write_geotiff(const fs::path& file, const TiffKind& kind) {
  TIFF* tiff = TIFFOpen(file.c_str(), "w");
  TIFFMergeFieldInfo(tiff, kGeoTags, 3);
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, kind.width);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, kind.height);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 3);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 1);
  const double scale[] = {0.5, 0.5, 0.0}, tie[] = {0, 0, 0, 500000, 5820000, 0};
  const std::uint16_t keys[] = {1,         1,    0, 2, kind.epsg_key, 0, 1,
                                kind.epsg, 1025, 0, 1, kind.raster};
  TIFFSetField(tiff, 33550, 3, scale);
  TIFFSetField(tiff, 33922, 6, tie);
  TIFFSetField(tiff, 34735, 12, keys);
  std::vector<std::uint8_t> row(3 * kind.width);
  for (std::uint32_t x = 0; x < kind.width; ++x) row[3 * x + (x < kind.width / 2 ? 0 : 1)] = 250;
  for (std::uint32_t y = 0; y < kind.height; ++y) TIFFWriteScanline(tiff, row.data(), y, 0);
  TIFFClose(tiff);
}

TEST(MapGrid, PlacesAreThoseOfTheSurveyors) {
  // As PROJ 9.1 computes them: proj +proj=utm +zone=33 (and 19 +south) +ellps=WGS84.
  const auto berlin = to_wgs84({32633}, 392081.0659, 5820156.1891);
  EXPECT_NEAR(berlin.lat_deg, 52.520815, 1e-8);
  EXPECT_NEAR(berlin.lon_deg, 13.409419, 1e-8);
  const auto santiago = to_wgs84({32719}, 346642.6950, 6297606.8325);
  EXPECT_NEAR(santiago.lat_deg, -33.45, 1e-8);
  EXPECT_NEAR(santiago.lon_deg, -70.65, 1e-8);
  EXPECT_NEAR(to_wgs84({32733}, 500000, 10000000).lat_deg, 0.0, 1e-9);
  EXPECT_NEAR(to_wgs84({3857}, 20037508.342789244, 0).lon_deg, 180.0, 1e-9);
  EXPECT_NEAR(to_wgs84({3857}, 0, 20037508.342789244).lat_deg, 85.0511287798, 1e-9);
  EXPECT_EQ(grid_named("world").epsg, Grid::kWorld);
  EXPECT_EQ(grid_named("EPSG:25832").epsg, 25832);
  for (const auto* name :
       {"", "EPSG:", "EPSG:0", "EPSG:32661", "EPSG:27700", "EPSG:4326x", "wgs84"})
    EXPECT_THROW(grid_named(name), std::invalid_argument) << name;
  EXPECT_THROW(to_wgs84({4326}, 13, 91), std::invalid_argument);
}

TEST_F(GroundMapFiles, TilesAreServedByZoomColumnAndRow) {
  write("tiles/12/2200/1343.png", "a tile");
  write("tiles/14/8800/5374.png", "finer");
  write("tiles/readme.txt", "no tile");
  const auto map = GroundMap::load(folder_ / "tiles");
  EXPECT_EQ(nlohmann::json::parse(map.description()),
            nlohmann::json::parse(R"({"kind": "tiles", "zoom_min": 12, "zoom_max": 14})"));
  const auto tile = get(map, "/map/12/2200/1343");
  ASSERT_TRUE(tile.file);
  EXPECT_EQ(tile.type, "image/png");
  EXPECT_EQ(tile.file->end, 6u);
  for (const auto* path : {"/map/12/2200/9", "/map/12", "/map/../readme.txt", "/map/"})
    EXPECT_EQ(get(map, path).status, 404) << path;
  write("tiles/15/1/1.jpg", "another kind");
  EXPECT_THAT(fault(folder_ / "tiles"), HasSubstr("one kind expected"));
  write("none/a/b.png", "no numbers");
  EXPECT_THAT(fault(folder_ / "none"), HasSubstr("zoom/x/y.png or zoom/x/y.jpg expected"));
}

TEST_F(GroundMapFiles, AnImageLiesWhereItsCornersOrItsWorldFileSay) {
  const auto yard = png("yard.png", 40, 20);
  write("yard.yaml", "{crs: world, west: -10, south: -5, east: 30, north: 15}");
  const auto map = described(yard);
  EXPECT_EQ(map["frame"], "world");
  EXPECT_EQ(map["corners"], nlohmann::json::parse("[[-10, 15], [30, 15], [30, -5], [-10, -5]]"));
  const auto field = png("field.png", 10, 10);
  write("field.pgw", "0.001\n0\n0\n-0.001\n13.0005\n51.9995\n");
  const auto corners = described(field)["corners"];
  EXPECT_NEAR(corners[0][0], 13.0, 1e-9);
  EXPECT_NEAR(corners[0][1], 52.0, 1e-9);
  EXPECT_NEAR(corners[2][0], 13.01, 1e-9);
  EXPECT_NEAR(corners[2][1], 51.99, 1e-9);
  EXPECT_TRUE(get(GroundMap::load(field), "/map/image").file);
  EXPECT_EQ(get(GroundMap::load(field), "/map/field.pgw").status, 404);
}

TEST_F(GroundMapFiles, AGeoTiffIsReadWithItsPlace) {
  const auto file = folder_ / "site.tif";
  write_geotiff(file, {});
  const auto map = GroundMap::load(file);
  const auto corners = nlohmann::json::parse(map.description())["corners"];
  EXPECT_NEAR(corners[0][0], 15.0, 1e-9);
  EXPECT_GT(corners[0][1].get<double>(), corners[3][1].get<double>());
  const double metre_deg = 360.0 / 40007863.0;  // of latitude, along a meridian
  EXPECT_NEAR(corners[0][1].get<double>() - corners[3][1].get<double>(), 1.0 * metre_deg,
              0.01 * metre_deg);
  const auto image = get(map, "/map/image");
  EXPECT_EQ(image.type, "image/jpeg");
  EXPECT_EQ(image.body.substr(0, 2), "\xff\xd8");
  write_geotiff(file, {.raster = 2});  // the tie is the first pixel's middle
  EXPECT_LT(described(file)["corners"][0][0].get<double>(), 15.0 - 1e-7);
}

TEST_F(GroundMapFiles, ABadFileIsRefusedWithWhatWasExpected) {
  EXPECT_THAT(fault(folder_ / "none.png"), HasSubstr("there is no such file or folder"));
  EXPECT_THAT(fault(write("a.gif", "GIF89a")), HasSubstr("neither a PNG nor a JPEG"));
  const auto lone = png("lone.png", 40, 20);
  EXPECT_THAT(fault(lone), HasSubstr("where it lies is not known"));
  write("lone.pgw", "0.5 0 0 -0.5 385100 5820050");
  EXPECT_THAT(fault(lone), HasSubstr("not in degrees"));
  write("lone.yaml", "{crs: EPSG:32633}");
  EXPECT_EQ(fault(lone), "");
  write("lone.yaml", "{crs: EPSG:27700}");
  EXPECT_THAT(fault(lone), HasSubstr("EPSG:4326, EPSG:4258, EPSG:3857"));
  write("lone.pgw", "0.5 0 0");
  EXPECT_THAT(fault(lone), HasSubstr("six numbers"));
  const auto flat = png("flat.png", 40, 20);
  write("flat.yaml", "{crs: EPSG:4326, west: 13, east: 12, south: 52}");
  EXPECT_THAT(fault(flat), HasSubstr("is not east of west"));
  EXPECT_THAT(fault(flat), HasSubstr("is not north of south, or one of them is missing"));
  write("flat.yaml", "{crs: EPSG:4326, west: 13, east: 14, south: 52, north: 95}");
  EXPECT_THAT(fault(flat), HasSubstr("no place on the Earth"));
}

TEST_F(GroundMapFiles, ABadTiffIsRefusedWithWhatWasExpected) {
  EXPECT_THAT(fault(write("cut.tif", "II*")), HasSubstr("no TIFF, or cut off"));
  const auto file = folder_ / "site.tif";
  write_geotiff(file, {.epsg = 27700});
  EXPECT_THAT(fault(file), HasSubstr("its grid is EPSG:27700"));
  write_geotiff(file, {.epsg_key = 2048, .epsg = 4326});
  EXPECT_THAT(fault(file), HasSubstr("no place on the Earth"));  // its numbers are metres
  write_geotiff(file, {});
  fs::resize_file(file, 20);
  EXPECT_NE(fault(file), "");
}

}  // namespace
}  // namespace foretrack::station
