// SPDX-License-Identifier: Apache-2.0
// A service under test in a thread of its own, and fake neighbours that feed it over real DDS.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <thread>

#include "core/common/grid_map.hpp"
#include "core/common/target.hpp"
#include "foretrack_msgs/msg/ServiceHealth.h"
#include "nav_msgs/msg/Odometry.h"
#include "services/common/service.hpp"
#include "services/convert/vehicle.hpp"
#include "tests/services/common/bus.hpp"

namespace foretrack::testing {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

inline ServiceOptions service_options() {
  ServiceOptions options;
  options.domain_id = domain_id();
  return options;
}

/// Runs until the end of the test.
class Running {
 public:
  explicit Running(std::function<void(const ServiceOptions&, Stop&)> run)
      : thread_([this, run = std::move(run)] { run(service_options(), stop_); }) {}
  ~Running() {
    stop_.request();
    thread_.join();
  }

 private:
  Stop stop_;
  std::thread thread_;
};

/// What stands beside the service: odometry of a vehicle at rest, and an ear for its health.
class Neighbours {
 public:
  Neighbours() : node_(node_options("neighbours")), odometry_(node_), health_(node_) {}

  Node& node() { return node_; }
  double now_s() { return node_.clock().now_s(); }

  VehicleState vehicle;  // sent with the present stamp
  void send_odometry() {
    vehicle.stamp_s = now_s();
    to_idl(vehicle, odometry_.sample());
    odometry_.write();
  }
  Writer<topics::Odometry>& odometry() { return odometry_; }

  /// Calls feed at 50 Hz until the condition holds; false after ten seconds.
  bool until(const std::function<bool()>& condition, const std::function<void()>& feed = {}) {
    double fed_s = 0.0;
    return eventually([&] {
      if (feed && now_s() - fed_s > 0.02) {
        fed_s = now_s();
        feed();
      }
      return condition();
    });
  }

  /// How many samples of the topic the service has refused, by its own account; for one reason, or
  /// for any.
  std::uint64_t refused(const std::string& topic, const std::string& reason = {}) {
    health_.take_each([this](const foretrack_msgs::msg::ServiceHealth& health) {
      for (const auto& row : health.topics()) {
        if (row.writes()) continue;
        auto& reasons = refused_[without_prefix(row.topic().c_str())];
        for (const auto& rejected : row.rejected())
          reasons[rejected.reason().c_str()] = rejected.samples();
      }
    });
    std::uint64_t sum = 0;
    for (const auto& [why, samples] : refused_[topic])
      if (reason.empty() || why == reason) sum += samples;
    return sum;
  }

 private:
  // rt/uav1/target/state is target/state.
  static std::string without_prefix(const std::string& name) {
    const std::string prefix = "uav1/";
    const auto at = name.find(prefix);
    return at == std::string::npos ? name : name.substr(at + prefix.size());
  }

  Node node_;
  Writer<topics::Odometry> odometry_;
  Reader<topics::ServiceHealth> health_;
  std::map<std::string, std::map<std::string, std::uint64_t>> refused_;
};

/// A free box of 12 × 12 × 4 m around (0, 0, 2).
inline GridMap free_map(double stamp_s) {
  GridMap map;
  map.stamp_s = stamp_s;
  map.resolution_m = 0.2;
  map.origin_enu_m = {-6.0, -6.0, 0.0};
  map.size = {60, 60, 20};
  map.cells.assign(map.cell_count(), 0);
  DistanceWorkspace workspace;
  update_distances(map, workspace);
  return map;
}

/// Walks along x at 1 m/s, 2 m before a vehicle at the origin.
inline TargetState walking_target(double stamp_s) {
  TargetState target;
  target.stamp_s = stamp_s;
  target.status = TrackStatus::kTracking;
  target.position_enu_m = {2.0, 0.0, 1.0};
  target.velocity_enu_m_s = {1.0, 0.0, 0.0};
  target.covariance = Mat6::Identity() * 0.01;
  target.body_yaw_rad = 0.0;
  target.body_yaw_variance_rad2 = 0.05;
  target.last_measurement_s = stamp_s;
  return target;
}

}  // namespace foretrack::testing
