// SPDX-License-Identifier: Apache-2.0
#include "services/files/config/scenario_file.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace foretrack {
namespace {

constexpr double kFar_m = 1000.0;
constexpr std::array<std::string_view, 3> kTrackFormats = {"opentraj", "xy", "id_frame_xy"};

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

void read_world(YamlReader& r, ScenarioFile& file) {
  Scenario& s = file.scenario;
  file.has_bounds = r.has("bounds_m");
  read_bounds(r, s.world);
  r.text("octree", file.octree);
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
    file.generator_has_seed = g.has("seed");
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

void read_stops(YamlReader& r, PersonParams& person) {
  r.list("stops", [&](YamlReader& item) {
    StandStill stop;
    item.number("at_s", stop.at_s, 0.0, 1e5);
    item.number("for_s", stop.for_s, 0.0, 1e5);
    person.stops.push_back(stop);
  });
}

void read_target(YamlReader& r, ScenarioFile& file) {
  TargetSpec& target = file.scenario.target;
  PersonParams& person = target.person;
  auto& random_stops = file.random_stops;
  r.text("person", file.scenario.person);
  r.points("route_m", target.route_m);
  r.number("speed_m_s", target.speed_m_s, 0.1, 5.0);
  r.number("acceleration_m_s2", person.acceleration_m_s2, 0.1, 20.0);
  r.number("corner_reach_m", target.corner_reach_m, 0.05, 5.0);
  r.number("height_m", person.height_m, 0.8, 2.5);
  file.has_shoulder_lead = r.has("shoulder_lead_s");
  r.number("shoulder_lead_s", person.shoulder_lead_s, -2.0, 2.0);
  r.number("shoulder_offset_rad", person.shoulder_offset_rad, -kPi, kPi);
  r.number("shoulder_sway_rad", person.shoulder_sway_rad, 0.0, kPi);
  r.number("shoulder_sway_hz", person.shoulder_sway_hz, 0.0, 3.0);
  r.number("start_s", person.start_s, 0.0, 600.0);
  read_stops(r, person);
  r.section("random_stops", [&](YamlReader& t) { read_random_stops(t, random_stops.emplace()); });
  if (random_stops && !person.stops.empty())
    r.fault("random_stops", "give either stops or random_stops");
  r.section("track", [&](YamlReader& t) { read_track(t, file.track.emplace()); });
  if (file.track && !target.route_m.empty()) r.fault("track", "give either route_m or track");
  if (file.track && (!person.stops.empty() || random_stops))
    r.fault("stops", "a recorded track has its own stops");
}

void read_bystander(YamlReader& r, BystanderSpec& bystander) {
  r.points("route_m", bystander.route_m);
  if (bystander.route_m.empty()) r.fault("route_m", "is needed, with one point at least");
  r.text("person", bystander.person);
  r.flag("loop", bystander.loop);
  r.number("speed_m_s", bystander.speed_m_s, 0.1, 5.0);
  r.number("acceleration_m_s2", bystander.walk.acceleration_m_s2, 0.1, 20.0);
  r.number("height_m", bystander.walk.height_m, 0.8, 2.5);
  r.number("start_s", bystander.walk.start_s, 0.0, 600.0);
  read_stops(r, bystander.walk);
}

void read_vehicle(YamlReader& r, Scenario& s) {
  if (r.has("position_m")) r.point("position_m", s.vehicle_enu_m.emplace());
  r.number("yaw_rad", s.vehicle_yaw_rad, -2.0 * kPi, 2.0 * kPi);
  r.flag("parked", s.parked);
  r.integer("system_id", s.autopilot.system_id, 1, 255);
}

void read_incident(YamlReader& r, Incident& incident) {
  int kind = 0, mode = static_cast<int>(incident.mode);
  if (!r.has("what")) r.fault("what", "is needed");
  r.number("at_s", incident.at_s, 0.0, 1e5);
  r.choice("what", kIncidentNames, kind);
  r.choice("mode", kFlightModeNames, mode);
  incident.kind = static_cast<IncidentKind>(kind);
  incident.mode = static_cast<FlightMode>(mode);
}

void read_order(YamlReader& r, OperatorOrder& order) {
  r.number("at_s", order.at_s, 0.0, 1e5);
  if (r.has("follow")) {
    int person = 0;
    r.integer("follow", person, 0, 1000000000);
    order.follow = static_cast<std::uint32_t>(person);
  }
  r.number("distance_m", order.framing.distance_m, 0.0, kFar_m);
  r.number("height_m", order.framing.height_m, -kFar_m, kFar_m);
  r.number("bearing_rad", order.framing.bearing_rad, -kPi, kPi);
  r.number("circling_rad_s", order.framing.circling_rad_s, -10.0, 10.0);
  if (order.follow && !order.framing.is_free())
    r.fault("follow", "give either whom to follow or a framing");
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
  r.number("flip_share", landmarks.flip_share, 0.0, 1.0);
  r.flag("fov_gated", landmarks.fov_gated);
  r.number("depth_noise_m", s.depth_camera.noise_m, 0.0, 1.0);
  r.number("depth_rate_hz", s.depth_camera.rate_hz, 1.0, 100.0);
  r.number("depth_range_m", s.depth_camera.range_max_m, 0.5, 100.0);
  r.number("depth_dropout", s.depth_camera.dropout, 0.0, 1.0);
  r.flag("people_all_round", s.people_all_round);
  r.flag("depth_images", s.depth_images);
  r.flag("color_images", s.color_images);
}

void read_wind(YamlReader& r, WindParams& wind) {
  r.point("mean_m_s", wind.mean_enu_m_s);
  r.number("gust_m_s", wind.gust_m_s, 0.0, 20.0);
  r.number("gust_time_s", wind.gust_time_s, 0.01, 100.0);
}

void read_encounter(YamlReader& r, ScenarioFile& file) {
  if (!r.has("encounter")) return;
  int kind = 0;
  r.choice("encounter", kEncounterKindNames, kind);
  file.encounter = static_cast<EncounterKind>(kind);
  for (const char* key : {"world", "bystanders", "vehicle"})
    if (r.has(key)) r.fault(key, "an encounter has its own");
  const Scenario& s = file.scenario;
  if (!s.target.route_m.empty() || file.track || file.random_stops ||
      !s.target.person.stops.empty())
    r.fault("target", "an encounter has its own route and stops");
}

void read_hiding(YamlReader& r, ScenarioFile& file) {
  if (!r.has("hiding")) return;
  int kind = 0;
  r.choice("hiding", kHidingKindNames, kind);
  file.hiding = static_cast<HidingKind>(kind);
  for (const char* key : {"world", "encounter", "vehicle", "duration_s"})
    if (r.has(key)) r.fault(key, "a hiding has its own");
  const Scenario& s = file.scenario;
  if (!s.target.route_m.empty() || file.track || file.random_stops ||
      !s.target.person.stops.empty())
    r.fault("target", "a hiding has its own route, speed and stops");
}

}  // namespace

ScenarioFile read_scenario_file(YamlReader& r) {
  ScenarioFile file;
  Scenario& s = file.scenario;
  r.section("world", [&](YamlReader& w) { read_world(w, file); });
  r.section("target", [&](YamlReader& t) { read_target(t, file); });
  r.list("bystanders", [&](YamlReader& b) { read_bystander(b, s.bystanders.emplace_back()); });
  r.section("vehicle", [&](YamlReader& v) { read_vehicle(v, s); });
  auto& incidents = s.autopilot.incidents;
  r.list("incidents", [&](YamlReader& i) { read_incident(i, incidents.emplace_back()); });
  std::ranges::stable_sort(incidents, {}, &Incident::at_s);
  r.list("orders", [&](YamlReader& o) { read_order(o, s.orders.emplace_back()); });
  std::ranges::stable_sort(s.orders, {}, &OperatorOrder::at_s);
  r.section("sensors", [&](YamlReader& v) { read_sensors(v, s); });
  r.section("wind", [&](YamlReader& w) { read_wind(w, s.wind); });
  int map = 0;
  r.choice("map", kMapSourceNames, map);
  s.map = static_cast<MapSource>(map);
  file.has_resolution = r.has("map_resolution_m");
  r.number("map_resolution_m", s.map_resolution_m, 0.05, 1.0);
  r.number("duration_s", s.duration_s, 0.1, 1e5);
  r.seed("seed", s.seed);
  read_encounter(r, file);
  read_hiding(r, file);
  r.finish();
  return file;
}

}  // namespace foretrack
