// SPDX-License-Identifier: Apache-2.0
// What the vehicles tell each other in; where this one belongs, what it keeps clear of, and where
// the others see the person out.
#pragma once

#include <array>
#include <optional>

#include "core/fleet/coordinate.hpp"
#include "core/planning/plan_params.hpp"
#include "foretrack_msgs/msg/FleetDivision.h"
#include "foretrack_msgs/msg/FleetMember.h"
#include "foretrack_msgs/msg/LocalMap.h"
#include "foretrack_msgs/msg/MovingBodies.h"
#include "foretrack_msgs/msg/PlannedTrajectory.h"
#include "foretrack_msgs/msg/SafetyState.h"
#include "foretrack_msgs/msg/TargetIntention.h"
#include "foretrack_msgs/msg/TargetPrediction.h"
#include "foretrack_msgs/msg/TargetState.h"
#include "px4_msgs/msg/BatteryStatus.h"
#include "services/onboard/inputs.hpp"

namespace foretrack {

/// Its own messages come back to whoever listens on a shared topic. One of its name that it did not
/// send is of somebody else.
class OwnEchoes {
 public:
  void add(std::uint32_t sequence_number, double stamp_s) {
    sent_s_[sequence_number % sent_s_.size()] = stamp_s;
  }
  /// Stamps pass through nanoseconds.
  bool has(std::uint32_t sequence_number, double stamp_s) const {
    return std::abs(sent_s_[sequence_number % sent_s_.size()] - stamp_s) < 1e-6;
  }

 private:
  std::array<double, 64> sent_s_{};  // the last ones
};

/// Tells ten times a second where the vehicle is, as soon as there is odometry. All else is silent
/// until another vehicle was heard, and its inputs are not read before.
class FleetService {
 public:
  /// Of planning's parameters it takes the hull and the gap to bodies.
  FleetService(Service& service, const FleetParams& params, const PlanningParams& planning);

 private:
  void take(const FleetMember& message);
  void tick();
  void take_inputs();
  FleetInput gather(double now_s);
  void tell(const FleetResult& result);
  void tell_stages(const FleetResult& result);
  void judge();

  Service& service_;
  FleetParams params_;
  GapParams body_;
  VehicleInput vehicle_;
  Reader<topics::FleetMember> member_reader_;
  Reader<topics::TargetState> target_reader_;
  Reader<topics::TargetIntention> intention_reader_;
  Reader<topics::TargetPrediction> prediction_reader_;
  Reader<topics::PlannedTrajectory> plan_reader_;
  Reader<topics::LocalMap> map_reader_;
  Reader<topics::SafetyState> gate_reader_;
  Reader<topics::Px4BatteryStatus> battery_reader_;
  Writer<topics::FleetMember> member_;
  Writer<topics::FleetDivision> division_;
  Writer<topics::FleetBodies> bodies_;
  Writer<topics::FleetTarget> fused_;

  FleetState state_;
  OwnEchoes echoes_;
  bool heard_any_ = false;
  double impostor_s_ = -1e18;  // when somebody of our name was heard
  double told_s_ = -1e18;
  TargetState target_;
  std::optional<IntentionAssessment> intention_;
  std::optional<Prediction> prediction_;
  std::optional<PlannedTrajectory> plan_;
  GridMap map_;
  bool flies_ = false;
  double battery_ = -1.0;
};

/// Until the stop is requested.
void run_fleet(const ServiceOptions& options, const FleetParams& params,
               const PlanningParams& planning, Stop& stop);

}  // namespace foretrack
