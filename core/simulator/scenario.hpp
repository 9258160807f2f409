// SPDX-License-Identifier: Apache-2.0
// All that decides a simulated flight: a plain value, read from YAML by services/files/config.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/common/framing.hpp"
#include "core/simulator/autopilot.hpp"
#include "core/simulator/bystander.hpp"
#include "core/simulator/depth_camera.hpp"
#include "core/simulator/encounter.hpp"
#include "core/simulator/fleet_scenario.hpp"
#include "core/simulator/generate_world.hpp"
#include "core/simulator/hiding.hpp"
#include "core/simulator/landmark_camera.hpp"
#include "core/simulator/quadrotor.hpp"
#include "core/simulator/track.hpp"

namespace foretrack {

/// Who is followed, and where they walk.
struct TargetSpec {
  std::vector<Vec2> route_m;      // empty, and no track: a route is generated from the seed
  std::vector<TrackPoint> track;  // a recorded pedestrian; instead of a route
  double speed_m_s = 1.5;
  double corner_reach_m = 0.45;
  PersonParams person;
};

/// Whether the map is given, or built from depth images.
enum class MapSource : std::uint8_t { kKnown, kDepth };
inline constexpr std::array<std::string_view, 2> kMapSourceNames = {"known", "depth"};
/// As scenario files have it.
constexpr std::string_view to_string(MapSource map) {
  return kMapSourceNames[static_cast<std::size_t>(map)];
}

/// What an operator orders in flight: one of the two.
struct OperatorOrder {
  double at_s = 0.0;
  std::optional<std::uint32_t> follow;  // a number of bodies; 0: nobody
  Framing framing;                      // unless somebody is to be followed
};

/// All that decides a simulated flight.
struct Scenario {
  std::string name = "unnamed";
  World world;  // the shapes given one by one
  WorldGenerator generator;
  TargetSpec target;
  std::optional<Vec3> vehicle_enu_m;   // none: 2 m behind the target, or the nearest free place
  double vehicle_yaw_rad = 0.0;        // used with vehicle_enu_m
  bool parked = false;                 // on the ground there, disarmed; else it hovers armed
  int vehicle_number = 0;              // of a fleet: each draws noise of its own
  std::vector<FleetVehicle> vehicles;  // empty: one, as the lines above say
  LinkParams link;                     // between them
  std::vector<FleetFailure> failures;
  QuadrotorParams quadrotor;
  AutopilotParams autopilot;
  WindParams wind;
  LandmarkCameraParams landmark_camera;
  DepthCameraParams depth_camera;
  bool people_all_round = false;  // bystanders are detected on every side, not only ahead
  bool depth_images = false;      // rendered also with the known map
  bool color_images = false;      // of the landmark camera, rendered, instead of its landmarks
  std::string person = "boy";     // who is rendered; services/offline/people has the names
  std::vector<BystanderSpec> bystanders;  // not on the known map
  std::vector<OperatorOrder> orders;      // in the order of their times; in lock-step flights
  std::optional<Encounter> encounter;     // what was staged, if something was
  std::optional<HidingKind> hiding;       // the same
  MapSource map = MapSource::kKnown;
  double map_resolution_m = 0.15;
  double duration_s = 60.0;
  std::uint64_t seed = 1;
};

/// The seed of one part of what is random: the vehicle (1), the route (2), the landmark camera (3),
/// the depth camera (4).
std::uint64_t seed_of(const Scenario& scenario, std::uint64_t part);

/// The given shapes and the generated ones. Where a route or track is given, generated shapes keep
/// clear of it.
World world_of(const Scenario& scenario);

/// The route, the track, or a generated route (generator.kind and seed decide). Throws
/// std::invalid_argument if the world leaves no way.
Walk walk_of(const Scenario& scenario, const World& world);

}  // namespace foretrack
