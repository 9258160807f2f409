// SPDX-License-Identifier: Apache-2.0
#include "services/files/config/load_scenario.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "core/common/random.hpp"
#include "services/files/config/apply_setting.hpp"
#include "services/files/config/fleet_file.hpp"
#include "services/files/config/octree_world.hpp"
#include "services/files/config/scenario_file.hpp"
#include "services/files/share/share.hpp"

namespace foretrack {
namespace {

namespace fs = std::filesystem;

constexpr double kTrackMargin_m = 8.0;
constexpr std::uint64_t kStopsPart = 5;  // of the scenario's seed; the simulator uses those below

// Beside the scenario's file, else as the working directory has it.
fs::path locate(const std::string& file, const fs::path& scenario_file) {
  const fs::path beside = scenario_file.parent_path() / file;
  return fs::exists(beside) ? beside : fs::path(file);
}

std::vector<TrackPoint> load_track(const TrackSource& source, const fs::path& scenario_file) {
  const fs::path file = locate(source.file, scenario_file);
  std::ifstream in(file, std::ios::binary);
  if (!in)
    throw std::invalid_argument(fmt::format("{}: target.track.file: cannot read {}",
                                            scenario_file.string(), file.string()));
  std::ostringstream text;
  text << in.rdbuf();
  const auto tracks = parse_tracks(text.str(), static_cast<TrackFormat>(source.format),
                                   source.rate_hz, file.string());
  auto points = track_of(tracks, source.pedestrian, file.string()).points;
  if (points.size() < 2)
    throw std::invalid_argument(
        fmt::format("{}: pedestrian {} has only one row", file.string(), source.pedestrian));
  for (auto& point : points) point.position_m += source.offset_m;
  return points;
}

// Around the track, and around what is there already if keep says so.
void bounds_around(const std::vector<TrackPoint>& track, bool keep, World& world) {
  const auto bounds = bounds_of(track);
  const Vec2 low = bounds.min() - Vec2::Constant(kTrackMargin_m);
  const Vec2 high = bounds.max() + Vec2::Constant(kTrackMargin_m);
  world.min_m.head<2>() = keep ? world.min_m.head<2>().cwiseMin(low).eval() : low;
  world.max_m.head<2>() = keep ? world.max_m.head<2>().cwiseMax(high).eval() : high;
}

void draw_stops(const RandomStops& random_stops, const Scenario& s, PersonParams& person) {
  Random random(s.seed * 16 + kStopsPart);
  const auto draw = [&](const Vec2& range) { return random.uniform(range.x(), range.y()); };
  double now_s = person.start_s + draw(random_stops.every_s);
  while (now_s < s.duration_s) {
    const double for_s = draw(random_stops.for_s);
    person.stops.push_back({now_s, for_s});
    now_s += for_s + draw(random_stops.every_s);
  }
}

void check_path(YamlReader& r, const Scenario& s) {
  const auto outside = [&](const Vec2& p) {
    return (p.array() < s.world.min_m.head<2>().array()).any() ||
           (p.array() > s.world.max_m.head<2>().array()).any();
  };
  for (const Vec2& p : s.target.route_m)
    if (outside(p))
      r.fault("target", fmt::format("route_m: ({}, {}) is outside world.bounds_m", p.x(), p.y()));
  for (const auto& bystander : s.bystanders)
    for (const Vec2& p : bystander.route_m)
      if (outside(p))
        r.fault("bystanders",
                fmt::format("route_m: ({}, {}) is outside world.bounds_m", p.x(), p.y()));
  for (const auto& p : s.target.track)
    if (outside(p.position_m))
      return r.fault("target", fmt::format("track: ({}, {}) is outside world.bounds_m",
                                           p.position_m.x(), p.position_m.y()));
}

// The file of a name, or the file itself.
fs::path find_scenario(const std::string& name_or_file) {
  if (fs::is_regular_file(name_or_file)) return name_or_file;
  for (const auto& folder : share_folders()) {
    const fs::path shipped = folder / "deploy" / "scenarios" / (name_or_file + ".yaml");
    if (fs::is_regular_file(shipped)) return shipped;
  }
  throw std::invalid_argument(fmt::format("no scenario file or name '{}'; shipped are {}",
                                          name_or_file, fmt::join(scenario_names(), ", ")));
}

void apply(const ScenarioOverrides& o, Scenario& s, std::optional<TrackSource>& track) {
  if (o.map) s.map = *o.map;
  if (o.duration_s) s.duration_s = *o.duration_s;
  if (o.seed) s.seed = *o.seed;
  if (o.color_images) s.color_images = true;
  if (o.vehicles) set_vehicles(*o.vehicles, s);
  if (o.track_file) {
    track.emplace().file = fs::absolute(*o.track_file).string();
    s.target.route_m.clear();
    s.target.person.stops.clear();
    if (track->file.ends_with(".xy") || track->file.ends_with(".csv")) track->format = 1;
    if (o.track_rate_hz) track->rate_hz = *o.track_rate_hz;
  }
  if (o.pedestrian && track) track->pedestrian = *o.pedestrian;
}

}  // namespace

Scenario load_scenario(const std::string& name_or_file, const ScenarioOverrides& overrides) {
  const fs::path file = find_scenario(name_or_file);
  Faults faults(file.string());
  YAML::Node document = load_yaml(file);
  for (const auto& setting : overrides.settings) apply_setting(setting, document);
  YamlReader r(document, "", faults);
  ScenarioFile read = read_scenario_file(r);
  faults.throw_if_any();
  Scenario& s = read.scenario;
  s.name = file.stem().string();
  apply(overrides, s, read.track);
  if (!read.generator_has_seed) s.generator.seed = s.seed;
  if (read.encounter) stage_encounter(*read.encounter, s);
  if (read.hiding) stage_hiding(*(s.hiding = read.hiding), s);
  if (read.track) s.target.track = load_track(*read.track, file);
  // A chest that leads would give the recorded future away, which nobody recorded of it.
  if (read.track && !read.has_shoulder_lead) s.target.person.shoulder_lead_s = 0.0;
  if (read.random_stops) draw_stops(*read.random_stops, s, s.target.person);
  if (!read.octree.empty()) {
    const double resolution_m = add_octree(locate(read.octree, file), !read.has_bounds, s.world);
    if (!read.has_resolution) s.map_resolution_m = std::clamp(resolution_m, 0.05, 1.0);
  }
  if (read.track && !read.has_bounds) bounds_around(s.target.track, !read.octree.empty(), s.world);
  check_path(r, s);
  faults.throw_if_any();
  return std::move(s);
}

std::vector<std::string> scenario_names() {
  std::vector<std::string> names;
  for (const auto& folder : share_folders()) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder / "deploy" / "scenarios", error))
      if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace foretrack
