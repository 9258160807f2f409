// SPDX-License-Identifier: Apache-2.0
// Writes a flight down, from what comes over DDS, in the rows that the metrics are made of.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/common/vehicle.hpp"
#include "core/simulator/scenario.hpp"
#include "services/offline/flight/flight_row.hpp"
#include "services/operator/listener.hpp"

namespace foretrack {

/// Rows are kStep_s apart in the stamps' time, whatever the messages' rate: truth is interpolated,
/// beliefs and decisions are the last that came. A row's time counts from the first row.
class FlightLog {
 public:
  static constexpr double kStep_s = 0.02;

  /// The scenario gives the true world and the camera, which no topic carries. wall_s: a steady
  /// clock; without it there is no wall_latency_ms().
  explicit FlightLog(const Scenario& scenario, std::function<double()> wall_s = {});

  /// Listens by these hooks. The log must outlive them.
  void attach(Hooks& hooks);

  const std::vector<FlightRow>& rows() const { return rows_; }
  /// The stamp of the first row; negative: there is none.
  double first_s() const { return first_s_; }
  /// Wall time of each stage of prediction and planning, one value a call.
  const std::map<std::string, std::vector<double>>& stage_ms() const { return stage_ms_; }
  /// From an image's stamp to the first setpoint that follows from it, one value an image.
  const std::vector<double>& latency_ms() const { return latency_ms_; }
  /// The same by the wall clock, from when the image was heard of; only where there are images.
  const std::vector<double>& wall_latency_ms() const { return wall_latency_ms_; }
  int plans() const { return plans_; }
  double path_length_m() const;

 private:
  struct HeardImage {
    double stamp_s = 0.0, at_s = 0.0;
  };
  void hear_image(double stamp_s);
  void hear_vehicle(const nav_msgs::msg::Odometry& odometry);
  void hear_target(const nav_msgs::msg::Odometry& odometry);
  void hear_prediction(const foretrack_msgs::msg::TargetPrediction& prediction);
  void hear_plan(const foretrack_msgs::msg::PlannedTrajectory& plan);
  void hear_safety(const foretrack_msgs::msg::SafetyState& safety);
  void take_latency(double stamp_s, double cause_s);
  void add_rows();
  void add_row(const VehicleState& vehicle, const VehicleState& target);

  Scenario scenario_;
  World world_;
  VehicleHistory vehicle_, target_;
  double first_s_ = -1.0, next_s_ = -1.0;
  FlightRow now_;  // the newest beliefs and decisions
  double last_cause_s_ = 0.0;
  std::function<double()> wall_s_;
  std::deque<HeardImage> images_;  // without a setpoint yet
  int plans_ = 0;
  std::vector<FlightRow> rows_;
  std::map<std::string, std::vector<double>> stage_ms_;
  std::vector<double> latency_ms_, wall_latency_ms_;
};

}  // namespace foretrack
