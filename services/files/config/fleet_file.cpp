// SPDX-License-Identifier: Apache-2.0
#include "services/files/config/fleet_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace foretrack {
namespace {

constexpr std::size_t kMaxVehicles = 16;

void read_vehicle(YamlReader& r, FleetVehicle& vehicle) {
  r.text("name", vehicle.name);
  if (r.has("position_m")) r.point("position_m", vehicle.position_enu_m.emplace());
  r.number("yaw_rad", vehicle.yaw_rad, -2.0 * kPi, 2.0 * kPi);
  r.point("frame_m", vehicle.frame_m);
  r.number("frame_yaw_rad", vehicle.frame_yaw_rad, -2.0 * kPi, 2.0 * kPi);
}

// A list of lists of names: [[uav1], [uav2, uav3]], each inner one by itself.
void read_partition(YamlReader& r, LinkPartition& partition) {
  r.number("from_s", partition.from_s, 0.0, 1e5);
  r.number("to_s", partition.to_s, 0.0, 1e5);
  if (partition.to_s <= partition.from_s) r.fault("to_s", "must be later than from_s");
  r.lists("groups", partition.groups);
  if (partition.groups.empty()) r.fault("groups", "is needed");
}

void read_link(YamlReader& r, LinkParams& link) {
  r.number("loss", link.loss, 0.0, 1.0);
  r.number("delay_s", link.delay_s, 0.0, 10.0);
  r.number("jitter_s", link.jitter_s, 0.0, 10.0);
  r.list("partitions",
         [&](YamlReader& item) { read_partition(item, link.partitions.emplace_back()); });
}

void read_failure(YamlReader& r, FleetFailure& failure) {
  int kind = 0;
  if (!r.has("vehicle")) r.fault("vehicle", "is needed");
  r.text("vehicle", failure.vehicle);
  r.number("at_s", failure.at_s, 0.0, 1e5);
  r.choice("kind", kFleetFailureNames, kind);
  failure.kind = static_cast<FleetFailureKind>(kind);
}

bool has_vehicle(const Scenario& s, const std::string& name) {
  return std::any_of(s.vehicles.begin(), s.vehicles.end(),
                     [&](const FleetVehicle& v) { return v.name == name; });
}

void check_names(YamlReader& r, const Scenario& s) {
  for (auto it = s.vehicles.begin(); it != s.vehicles.end(); ++it)
    if (std::any_of(s.vehicles.begin(), it, [&](const auto& v) { return v.name == it->name; }))
      r.fault("vehicles", fmt::format("'{}' is there twice", it->name));
  for (const LinkPartition& partition : s.link.partitions)
    for (const auto& group : partition.groups)
      for (const std::string& name : group)
        if (!has_vehicle(s, name)) r.fault("link", fmt::format("there is no vehicle '{}'", name));
  for (const FleetFailure& failure : s.failures)
    if (!has_vehicle(s, failure.vehicle))
      r.fault("failures", fmt::format("there is no vehicle '{}'", failure.vehicle));
}

}  // namespace

void set_vehicles(int count, Scenario& s) {
  if (count < 1 || count > static_cast<int>(kMaxVehicles))
    throw std::invalid_argument(fmt::format("{} vehicles: 1 to {} expected", count, kMaxVehicles));
  s.vehicles.resize(std::min(s.vehicles.size(), static_cast<std::size_t>(count)));
  for (std::size_t n = 1; s.vehicles.size() < static_cast<std::size_t>(count); ++n)
    if (const auto name = fmt::format("uav{}", n); !has_vehicle(s, name))
      s.vehicles.emplace_back().name = name;
  std::erase_if(s.failures, [&](const auto& f) { return !has_vehicle(s, f.vehicle); });
}

void read_fleet(YamlReader& r, Scenario& s) {
  if (r.has("vehicles") && r.has("vehicle")) r.fault("vehicles", "give either vehicle or vehicles");
  r.list("vehicles", [&](YamlReader& item) {
    FleetVehicle& vehicle = s.vehicles.emplace_back();
    vehicle.name = fmt::format("uav{}", s.vehicles.size());
    read_vehicle(item, vehicle);
  });
  if (s.vehicles.size() > kMaxVehicles)
    r.fault("vehicles",
            fmt::format("{} of them, expected {} at most", s.vehicles.size(), kMaxVehicles));
  r.section("link", [&](YamlReader& item) { read_link(item, s.link); });
  r.list("failures", [&](YamlReader& item) { read_failure(item, s.failures.emplace_back()); });
  check_names(r, s);
}

}  // namespace foretrack
