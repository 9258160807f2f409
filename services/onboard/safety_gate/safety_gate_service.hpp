// SPDX-License-Identifier: Apache-2.0
// Plans, orders, the map, bodies around and the flight controller's state in; setpoints, the
// heartbeat and requests out.
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <string>

#include "core/fleet/use_fleet.hpp"
#include "core/safety/gate.hpp"
#include "foretrack_msgs/msg/LocalMap.h"
#include "foretrack_msgs/msg/MissionCommand.h"
#include "foretrack_msgs/msg/MovingBodies.h"
#include "foretrack_msgs/msg/PlannedTrajectory.h"
#include "foretrack_msgs/msg/SafetyState.h"
#include "services/onboard/inputs.hpp"
#include "services/onboard/safety_gate/autopilot_link.hpp"
#include "services/onboard/safety_gate/memory_writer.hpp"

namespace foretrack {

/// Ticks at 100 Hz. The only writer of what the flight controller obeys. Its state goes out at
/// 20 Hz, and at once when the mode, the flown trajectory or an order's result changes. Plans,
/// odometry, the map and bodies are each heard from one writer. Orders are heard from all; a second
/// writer of them that does not prove the lease is an alarm as well.
class SafetyGateService {
 public:
  /// Remembers the mission in `memory_file`; empty: nowhere.
  SafetyGateService(Service& service, const SafetyParams& params, bool dry_run,
                    const std::filesystem::path& memory_file);

  /// See AutopilotLink.
  std::string_view better_release() const { return autopilot_.better_release(); }

 private:
  void remember_start(const std::filesystem::path& memory_file);
  void hear_order(const foretrack_msgs::msg::MissionCommand& message);
  bool proves_the_lease(const MissionCommand& order) const;
  void notice_source(const MissionCommand& order);
  void tick();
  void read_bodies(GateInput& in);
  void tell_turn(const GateResult& now) const;
  void publish(const GateResult& result);
  bool is_news(const GateResult& result) const;
  bool is_blind() const;
  std::string alarm();

  Service& service_;
  SafetyParams params_;
  bool dry_run_;
  GateState state_;
  MemoryWriter memory_;
  AutopilotLink autopilot_;
  VehicleInput vehicle_;
  Reader<topics::PlannedTrajectory> plan_reader_;
  Reader<topics::LocalMap> map_reader_;
  Reader<topics::MovingBodies> bodies_reader_;
  Reader<topics::FleetBodies> peers_reader_;
  Reader<topics::MissionCommand> order_reader_;
  Writer<topics::SafetyState> report_;
  std::optional<PlannedTrajectory> plan_;  // that the gate has not seen
  std::optional<GridMap> map_;
  double map_at_s_ = -1.0;
  std::optional<MovingBodies> bodies_;
  double bodies_at_s_ = -1.0;
  std::optional<MovingBodies> peers_;  // other vehicles; none: no fleet was heard
  double peers_at_s_ = -1.0;
  MovingBodies kept_clear_;                         // bodies and peers
  bool color_blind_ = false, depth_blind_ = false;  // as perception and mapping say with these
  double operator_at_s_ = -1.0;
  std::deque<MissionCommand> orders_;
  GateResult last_;
  double now_s_ = -1e18;  // of the last tick, monotonic
  double reported_s_ = -1e18;
  std::uint64_t orders_of_others_ = 0;             // of a second writer, so far
  std::uint64_t strange_orders_ = 0;               // and without a proof of the lease
  std::array<std::uint64_t, 6> second_writers_{};  // samples of them so far, by input
  double second_writer_s_ = -1e18;                 // when the last one came
  std::string second_writer_of_;
};

/// Until the stop is requested.
void run_safety_gate(const ServiceOptions& options, const SafetyParams& params, Stop& stop);

}  // namespace foretrack
