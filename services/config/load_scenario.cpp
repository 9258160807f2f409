#include "services/config/load_scenario.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "core/common/random.hpp"
#include "services/config/octree_world.hpp"
#include "services/share/share.hpp"
#include "services/yaml/yaml_reader.hpp"

namespace foretrack {
namespace {

namespace fs = std::filesystem;

constexpr double kFar_m = 1000.0;
constexpr double kTrackMargin_m = 8.0;
constexpr std::uint64_t kStopsPart = 5;  // of the scenario's seed; the simulator uses those below
constexpr std::array<std::string_view, 2> kTrackFormats = {"opentraj", "xy"};

struct TrackSource {
  std::string file;
  int format = 0;
  int pedestrian = 1;
  double rate_hz = 25.0;
  Vec2 offset_m = Vec2::Zero();
};

// Stops drawn from the scenario's seed: the walks between them, and how long they last.
struct RandomStops {
  Vec2 every_s = Vec2::Zero();
  Vec2 for_s = Vec2(1.0, 3.0);
};

void check_extent(YamlReader& r, std::string_view key, const Vec3& min, const Vec3& max) {
  if (!(max - min).array().isFinite().all() || ((max - min).array() <= 0.0).any())
    r.fault(key, "the greatest corner must exceed the least one on every axis");
  if (min.cwiseAbs().maxCoeff() > kFar_m || max.cwiseAbs().maxCoeff() > kFar_m)
    r.fault(key, fmt::format("coordinates must be within {} m", kFar_m));
}

void read_bounds(YamlReader& r, World& world) {
  std::vector<double> v;
  if (!r.numbers("bounds_m", v, 6)) return;
  world.min_m = {v[0], v[1], v[2]};
  world.max_m = {v[3], v[4], v[5]};
  check_extent(r, "bounds_m", world.min_m, world.max_m);
}

void read_world(YamlReader& r, Scenario& s, bool& generator_has_seed, std::string& octree) {
  read_bounds(r, s.world);
  r.text("octree", octree);
  r.list("boxes", [&](YamlReader& item) {
    Box box;
    if (!item.has("min_m") || !item.has("max_m")) item.fault("min_m", "min_m and max_m are needed");
    item.point("min_m", box.min_m);
    item.point("max_m", box.max_m);
    check_extent(item, "max_m", box.min_m, box.max_m);
    s.world.boxes.push_back(box);
  });
  r.list("cylinders", [&](YamlReader& item) {
    Cylinder cylinder;
    if (!item.has("center_m")) item.fault("center_m", "is needed");
    item.point("center_m", cylinder.center_m);
    item.number("radius_m", cylinder.radius_m, 0.01, kFar_m);
    item.number("height_m", cylinder.height_m, 0.01, kFar_m);
    item.number("base_m", cylinder.base_m, -kFar_m, kFar_m);
    s.world.cylinders.push_back(cylinder);
  });
  r.section("generator", [&](YamlReader& g) {
    int kind = 0;
    g.choice("kind", kWorldKindNames, kind);
    s.generator.kind = static_cast<WorldKind>(kind);
    g.integer("count", s.generator.count, 0, 2000);
    generator_has_seed = g.has("seed");
    g.seed("seed", s.generator.seed);
  });
}

void read_track(YamlReader& r, TrackSource& track) {
  if (!r.has("file")) r.fault("file", "is needed");
  r.text("file", track.file);
  r.choice("format", kTrackFormats, track.format);
  r.integer("pedestrian", track.pedestrian, 0, 1000000000);
  r.number("rate_hz", track.rate_hz, 0.01, 1000.0);
  r.point("offset_m", track.offset_m);
}

void read_random_stops(YamlReader& r, RandomStops& stops) {
  if (!r.has("every_s")) r.fault("every_s", "is needed");
  r.point("every_s", stops.every_s);
  r.point("for_s", stops.for_s);
  if (stops.every_s.x() < 0.5 || stops.every_s.y() < stops.every_s.x())
    r.fault("every_s", "expected [least, greatest], the least at least 0.5 s");
  if (stops.for_s.x() < 0.0 || stops.for_s.y() < stops.for_s.x())
    r.fault("for_s", "expected [least, greatest]");
}

void read_target(YamlReader& r, TargetSpec& target, std::optional<TrackSource>& track,
                 std::optional<RandomStops>& random_stops) {
  PersonParams& person = target.person;
  r.points("route_m", target.route_m);
  r.number("speed_m_s", target.speed_m_s, 0.1, 5.0);
  r.number("acceleration_m_s2", person.acceleration_m_s2, 0.1, 20.0);
  r.number("corner_reach_m", target.corner_reach_m, 0.05, 5.0);
  r.number("height_m", person.height_m, 0.8, 2.5);
  r.number("shoulder_lead_s", person.shoulder_lead_s, 0.0, 2.0);
  r.number("start_s", person.start_s, 0.0, 600.0);
  r.list("stops", [&](YamlReader& item) {
    StandStill stop;
    item.number("at_s", stop.at_s, 0.0, 1e5);
    item.number("for_s", stop.for_s, 0.0, 1e5);
    person.stops.push_back(stop);
  });
  r.section("random_stops", [&](YamlReader& t) { read_random_stops(t, random_stops.emplace()); });
  if (random_stops && !person.stops.empty())
    r.fault("random_stops", "give either stops or random_stops");
  r.section("track", [&](YamlReader& t) { read_track(t, track.emplace()); });
  if (track && !target.route_m.empty()) r.fault("track", "give either route_m or track");
  if (track && (!person.stops.empty() || random_stops))
    r.fault("stops", "a recorded track has its own stops");
}

void read_vehicle(YamlReader& r, Scenario& s) {
  if (r.has("position_m")) r.point("position_m", s.vehicle_enu_m.emplace());
  r.number("yaw_rad", s.vehicle_yaw_rad, -2.0 * kPi, 2.0 * kPi);
}

void read_sensors(YamlReader& r, Scenario& s) {
  LandmarkCameraParams& landmarks = s.landmark_camera;
  r.number("landmark_noise_px", landmarks.noise_px, 0.0, 100.0);
  r.number("joint_noise_m", landmarks.joint_noise_m, 0.0, 1.0);
  r.number("correlated_share", landmarks.correlated_share, 0.0, 1.0);
  r.number("landmark_height_m", landmarks.landmark_height_m, 0.8, 2.5);
  r.number("landmark_rate_hz", landmarks.rate_hz, 1.0, 100.0);
  r.number("landmark_range_m", landmarks.range_max_m, 0.5, 100.0);
  r.number("delay_s", landmarks.delay_s, 0.0, 2.0);
  r.number("dropout", landmarks.dropout, 0.0, 1.0);
  r.flag("fov_gated", landmarks.fov_gated);
  r.number("depth_noise_m", s.depth_camera.noise_m, 0.0, 1.0);
  r.number("depth_rate_hz", s.depth_camera.rate_hz, 1.0, 100.0);
  r.number("depth_range_m", s.depth_camera.range_max_m, 0.5, 100.0);
  r.number("depth_dropout", s.depth_camera.dropout, 0.0, 1.0);
  r.flag("depth_images", s.depth_images);
  r.flag("color_images", s.color_images);
}

void read_wind(YamlReader& r, WindParams& wind) {
  r.point("mean_m_s", wind.mean_enu_m_s);
  r.number("gust_m_s", wind.gust_m_s, 0.0, 20.0);
  r.number("gust_time_s", wind.gust_time_s, 0.01, 100.0);
}

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
  Vec2 low = track.front().position_m, high = low;
  for (const auto& point : track) {
    low = low.cwiseMin(point.position_m);
    high = high.cwiseMax(point.position_m);
  }
  low.array() -= kTrackMargin_m;
  high.array() += kTrackMargin_m;
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

[[noreturn]] void refuse_setting(const std::string& setting) {
  throw std::invalid_argument(
      fmt::format("setting '{}': expected KEY=VALUE with a key of the scenario file, as in "
                  "target.speed_m_s=2.0",
                  setting));
}

// Puts a value where the file would have it; mappings on the way are made.
void apply_setting(const std::string& setting, const YAML::Node& document) {
  const auto equals = setting.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == setting.size())
    refuse_setting(setting);
  YAML::Node value;
  try {
    value = YAML::Load(setting.substr(equals + 1));
  } catch (const YAML::ParserException&) {
    refuse_setting(setting);
  }
  std::istringstream path(setting.substr(0, equals));
  std::vector<std::string> keys;
  for (std::string key; std::getline(path, key, '.');) keys.push_back(key);
  YAML::Node node = document;
  for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
    if (node.IsDefined() && !node.IsNull() && !node.IsMap()) refuse_setting(setting);
    node.reset(node[keys[i]]);
  }
  if (keys.empty() || (node.IsDefined() && !node.IsNull() && !node.IsMap()))
    refuse_setting(setting);
  node[keys.back()] = value;
}

void check_path(YamlReader& r, const Scenario& s) {
  const auto outside = [&](const Vec2& p) {
    return (p.array() < s.world.min_m.head<2>().array()).any() ||
           (p.array() > s.world.max_m.head<2>().array()).any();
  };
  for (const Vec2& p : s.target.route_m)
    if (outside(p))
      r.fault("target", fmt::format("route_m: ({}, {}) is outside world.bounds_m", p.x(), p.y()));
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
  Scenario s;
  s.name = file.stem().string();
  std::optional<TrackSource> track;
  std::optional<RandomStops> random_stops;
  std::string octree;
  bool generator_has_seed = false, has_bounds = false, has_resolution = false;
  r.section("world", [&](YamlReader& w) {
    has_bounds = w.has("bounds_m");
    read_world(w, s, generator_has_seed, octree);
  });
  r.section("target", [&](YamlReader& t) {
    t.text("person", s.person);
    read_target(t, s.target, track, random_stops);
  });
  r.section("vehicle", [&](YamlReader& v) { read_vehicle(v, s); });
  r.section("sensors", [&](YamlReader& v) { read_sensors(v, s); });
  r.section("wind", [&](YamlReader& w) { read_wind(w, s.wind); });
  int map = 0;
  r.choice("map", kMapSourceNames, map);
  s.map = static_cast<MapSource>(map);
  has_resolution = r.has("map_resolution_m");
  r.number("map_resolution_m", s.map_resolution_m, 0.05, 1.0);
  r.number("duration_s", s.duration_s, 0.1, 1e5);
  r.seed("seed", s.seed);
  r.finish();
  faults.throw_if_any();
  apply(overrides, s, track);
  if (!generator_has_seed) s.generator.seed = s.seed;
  if (track) s.target.track = load_track(*track, file);
  if (random_stops) draw_stops(*random_stops, s, s.target.person);
  if (!octree.empty()) {
    const double resolution_m = add_octree(locate(octree, file), !has_bounds, s.world);
    if (!has_resolution) s.map_resolution_m = std::clamp(resolution_m, 0.05, 1.0);
  }
  if (track && !has_bounds) bounds_around(s.target.track, !octree.empty(), s.world);
  check_path(r, s);
  faults.throw_if_any();
  return s;
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
