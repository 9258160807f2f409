// SPDX-License-Identifier: Apache-2.0
// Hears all vehicles of a fleet, each as an operator of it alone would, and puts their flights into
// the rows that a fleet's metrics are made of.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "foretrack_msgs/msg/FleetDivision.h"
#include "foretrack_msgs/msg/FleetMember.h"
#include "services/offline/flight/fly_fleet.hpp"
#include "services/operator/flight_log.hpp"
#include "services/operator/listener.hpp"
#include "services/operator/order_sender.hpp"

namespace foretrack {

/// One vehicle as it is heard: by a participant of its own.
struct HeardVehicle {
  HeardVehicle(const NodeOptions& options, const Scenario& scenario);

  /// Whether it said something in the last second before that time, by the flight's clock.
  bool is_alive(double now_s) const;

  std::string name;
  std::unique_ptr<Node> node;
  std::unique_ptr<Listener> listener;
  std::unique_ptr<FlightLog> log;
  std::unique_ptr<Reader<topics::FleetDivision>> division;
  double heard_s = -1e9;  // stamp of its gate's last word
  int seat = -1;
  bool is_near = false;
};

class FleetLog {
 public:
  /// options: of a participant, whose vehicle is exchanged for each of the scenario's.
  FleetLog(const NodeOptions& options, const Scenario& scenario);

  /// Takes all that came. Call it two hundred times a second.
  void update();
  const std::vector<std::unique_ptr<HeardVehicle>>& vehicles() const { return vehicles_; }
  const std::vector<FleetRow>& rows() const { return rows_; }
  /// All that was heard, measured.
  FleetFlight flight(const MetricParams& metrics, const FleetParams& params) const;

 private:
  double newest_s() const;
  void add_row(double time_s);
  FleetRowMember member_at(const HeardVehicle& vehicle, double time_s, const FlightRow& row) const;

  Scenario scenario_;
  std::vector<std::unique_ptr<HeardVehicle>> vehicles_;
  Reader<topics::FleetMember> members_;
  double told_bytes_ = 0.0;  // since the last row
  double first_s_ = -1.0, next_s_ = -1.0;
  double set_off_s_ = 1e18;  // when the person began to walk: failures count from then
  std::vector<FleetRow> rows_;
};

}  // namespace foretrack
