// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/ground_map/grid.hpp"

#include <fmt/format.h>

#include <GeographicLib/UTMUPS.hpp>
#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace foretrack::station {
namespace {

constexpr int kDegrees = 4326, kDegreesEurope = 4258, kMercator = 3857;
constexpr double kMercatorRadius_m = 6378137.0;

struct UtmZone {
  int zone = 0;  // 0: none
  bool north = true;
};

UtmZone utm_zone(int epsg) {
  const int zone = epsg % 100;
  const bool north = epsg / 100 == 326 || epsg / 100 == 258;
  if (zone < 1 || zone > 60 || (!north && epsg / 100 != 327)) return {};
  return {zone, north};
}

Wgs84 checked(Wgs84 place, double x, double y) {
  if (std::abs(place.lat_deg) <= 90.0 && std::abs(place.lon_deg) <= 360.0) return place;
  throw std::invalid_argument(fmt::format("{}, {} is no place on the Earth", x, y));
}

Wgs84 from_utm(UtmZone utm, double x, double y) try {
  Wgs84 place;
  GeographicLib::UTMUPS::Reverse(utm.zone, utm.north, x, y, place.lat_deg, place.lon_deg);
  return place;
} catch (const GeographicLib::GeographicErr& error) {
  throw std::invalid_argument(error.what());
}

}  // namespace

bool is_known(Grid grid) {
  const int epsg = grid.epsg;
  return epsg == Grid::kWorld || epsg == kDegrees || epsg == kDegreesEurope || epsg == kMercator ||
         utm_zone(epsg).zone > 0;
}

Grid grid_named(std::string_view name) {
  constexpr std::string_view kPrefix = "EPSG:";
  Grid grid{Grid::kWorld};
  if (name == "world") return grid;
  if (name.starts_with(kPrefix)) {
    const auto digits = name.substr(kPrefix.size());
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), grid.epsg);
    const bool whole = error == std::errc() && end == digits.data() + digits.size();
    if (whole && grid.epsg != Grid::kWorld && is_known(grid)) return grid;
  }
  throw std::invalid_argument(
      fmt::format("\"{}\": EPSG:4326, EPSG:4258, EPSG:3857, a UTM zone (EPSG:326xx, 327xx, 258xx) "
                  "or world expected",
                  name));
}

Wgs84 to_wgs84(Grid grid, double x, double y) {
  if (const auto utm = utm_zone(grid.epsg); utm.zone > 0) return checked(from_utm(utm, x, y), x, y);
  if (grid.epsg != kMercator) return checked({y, x}, x, y);
  const double to_deg = 180.0 / std::numbers::pi;
  return checked(
      {std::atan(std::sinh(y / kMercatorRadius_m)) * to_deg, x / kMercatorRadius_m * to_deg}, x, y);
}

}  // namespace foretrack::station
