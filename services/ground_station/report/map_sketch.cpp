// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/report/map_sketch.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace foretrack::station {
namespace {

constexpr double kWidth_px = 640.0, kMargin_px = 30.0;
constexpr double kLeastHeight_px = 160.0, kMostHeight_px = 480.0;
constexpr double kLeast_m = 8.0;  // across
constexpr double kMostFar_m = 1e5;
constexpr std::size_t kMostPoints = 2000;

/// From metres to the drawing.
struct Place {
  double west_m = 1e18, east_m = -1e18, south_m = 1e18, north_m = -1e18;
  double scale = 1.0;  // pixels to a metre
  double height_px = kLeastHeight_px;

  void add(const StoryPoint& p) {
    west_m = std::min(west_m, p.x_m);
    east_m = std::max(east_m, p.x_m);
    south_m = std::min(south_m, p.y_m);
    north_m = std::max(north_m, p.y_m);
  }
  bool is_drawn() const { return east_m >= west_m && east_m - west_m < kMostFar_m; }
  void fit() {
    const double wide_m = std::max(kLeast_m, east_m - west_m);
    const double high_m = std::max(kLeast_m, north_m - south_m);
    scale =
        std::min((kWidth_px - 2 * kMargin_px) / wide_m, (kMostHeight_px - 2 * kMargin_px) / high_m);
    height_px = std::max(kLeastHeight_px, scale * (north_m - south_m) + 2 * kMargin_px);
  }
  double x(const StoryPoint& p) const {
    return kWidth_px / 2 + scale * (p.x_m - (west_m + east_m) / 2);
  }
  double y(const StoryPoint& p) const {
    return height_px / 2 - scale * (p.y_m - (south_m + north_m) / 2);
  }
};

std::string line(const Place& place, const std::vector<StoryPoint>& points, const char* what) {
  if (points.size() < 2) return {};
  const std::size_t step = points.size() / kMostPoints + 1;
  std::string text = fmt::format("<polyline class=\"{}\" points=\"", what);
  for (std::size_t i = 0; i < points.size(); i += step)
    text += fmt::format("{:.1f},{:.1f} ", place.x(points[i]), place.y(points[i]));
  return text + "\"/>\n";
}

double ruler_m(double scale) {
  for (const double m : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0})
    if (m * scale > 60.0) return m;
  return 2000.0;
}

std::string mark(const Place& place, const StoryPoint& at, const char* what, std::string label) {
  return fmt::format(
      "<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"6\"/><text x=\"{:.1f}\" y=\"{:.1f}\">{}"
      "</text>\n",
      what, place.x(at), place.y(at), place.x(at) + 9, place.y(at) + 4, label);
}

}  // namespace

std::string map_sketch(const VehicleStory& vehicle) {
  Place place;
  for (const auto* track : {&vehicle.track, &vehicle.person})
    for (const auto& point : *track) place.add(point);
  if (!place.is_drawn()) return {};
  place.fit();
  std::string svg = fmt::format(
      "<svg class=\"map\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"ways from above, "
      "north "
      "up\">\n",
      kWidth_px, place.height_px);
  svg += line(place, vehicle.person, "person") + line(place, vehicle.track, "vehicle");
  if (!vehicle.track.empty()) {
    svg += mark(place, vehicle.track.front(), "begin", "begin");
    svg += mark(place, vehicle.track.back(), "end", "end");
  }
  for (std::size_t i = 0; i < vehicle.losses.size(); ++i)
    if (vehicle.losses[i].where)
      svg += mark(place, *vehicle.losses[i].where, "loss", fmt::format("lost {}", i + 1));
  const double ruler = ruler_m(place.scale);
  svg += fmt::format(
      "<path class=\"ruler\" d=\"M12 {:.1f}h{:.1f}\"/><text x=\"12\" y=\"{:.1f}\">{:g} m</text>"
      "<text x=\"{}\" y=\"20\">N ↑</text></svg>\n",
      place.height_px - 12, ruler * place.scale, place.height_px - 18, ruler, kWidth_px - 36);
  return svg;
}

}  // namespace foretrack::station
