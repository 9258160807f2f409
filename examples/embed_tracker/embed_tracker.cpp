// SPDX-License-Identifier: Apache-2.0
// All stages in one thread and without DDS: your odometry and your observations of the person go
// in, setpoints for your flight controller come out. A made-up walk and a vehicle that flies
// exactly as it is told stand here for yours.
#include <algorithm>
#include <cstdio>

#include "core/tracker/tracker.hpp"

namespace {

using namespace foretrack;

constexpr double kStep_s = 0.01;  // step() is called at 100 Hz
constexpr int kImageSteps = 3;    // an observation comes every third step

// A map of the site: free space of 18 × 18 × 4.5 m with one wall.
GridMap make_map() {
  GridMap map;
  map.origin_enu_m = Vec3(-6.0, -6.0, 0.0);
  map.size = Eigen::Vector3i(120, 120, 30);
  map.cells.assign(map.cell_count(), static_cast<std::uint8_t>(Cell::kFree));
  for (int y = 80; y < 120; ++y)
    for (int z = 0; z < 20; ++z)
      map.cells[map.offset_of({50, y, z})] = static_cast<std::uint8_t>(Cell::kOccupied);
  DistanceWorkspace workspace;
  update_distances(map, workspace);
  return map;
}

// The torso of somebody who walks along x at 1.2 m/s and turns left after 5 s.
Vec3 person_at(double time_s) {
  const double before_s = std::min(time_s, 5.0), after_s = time_s - before_s;
  return {1.2 * before_s, 1.2 * after_s, 1.1};
}

// Your detector's answer: a position with its covariance. 33 landmarks in the image would do, too.
TargetObservation observe(double time_s) {
  TargetObservation observation;
  observation.stamp_s = time_s;
  observation.kind = TargetObservation::Kind::kPosition;
  observation.position_enu_m = person_at(time_s);
  observation.covariance_m2 = 0.0025 * Mat3::Identity();
  return observation;
}

// Your flight controller: it hovers, gives its consent when it is asked for, and then flies what it
// is told. Its odometry is what `vehicle` holds.
struct FlightController {
  VehicleState vehicle;
  AutopilotStatus status{.armed = true, .mode = FlightMode::kHold};

  void obey(const GateResult& gate) {
    if (gate.request == AutopilotRequest::kOffboard) {
      status.offboard = true;
      status.mode = FlightMode::kOffboard;
    }
    if (!gate.setpoint) return;
    vehicle.position_enu_m = gate.setpoint->position_enu_m;
    vehicle.velocity_enu_m_s = gate.setpoint->velocity_enu_m_s;
    vehicle.q_world_body = Eigen::AngleAxisd(gate.setpoint->yaw_rad, Vec3::UnitZ());
  }
};

}  // namespace

int main() {
  const TrackerParams params;  // or change fields: params.planning.place.distance_low_m = 2.0;
  const GridMap map = make_map();
  TrackerState tracker(params);
  FlightController controller;
  controller.vehicle.position_enu_m = Vec3(-2.0, 0.0, 1.5);
  double nearest_m = 1e9, farthest_m = 0.0;
  int setpoints = 0;
  for (int i = 1; i <= 1000; ++i) {
    const double now_s = i * kStep_s;
    controller.vehicle.stamp_s = controller.status.stamp_s = now_s;
    const TargetObservation observation = observe(now_s);
    const MissionCommand start{.id = 1, .stamp_s = now_s, .order = MissionOrder::kStart};
    const TrackerOutput out = step(tracker,
                                   {.now_s = now_s,
                                    .vehicle = controller.vehicle,
                                    .autopilot = controller.status,
                                    .observation = i % kImageSteps == 0 ? &observation : nullptr,
                                    .known_map = &map,
                                    .command = i == 1 ? &start : nullptr},
                                   params);
    controller.obey(out.gate);
    setpoints += out.gate.setpoint ? 1 : 0;
    const double distance_m =
        (controller.vehicle.position_enu_m - person_at(now_s)).head<2>().norm();
    nearest_m = std::min(nearest_m, distance_m);
    farthest_m = std::max(farthest_m, distance_m);
  }
  std::printf("%d setpoints in 10 s; %.1f to %.1f m from the person\n", setpoints, nearest_m,
              farthest_m);
  return setpoints > 800 && nearest_m > 1.0 && farthest_m < 5.0 ? 0 : 1;
}
