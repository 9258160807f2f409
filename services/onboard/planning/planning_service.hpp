// SPDX-License-Identifier: Apache-2.0
// Vehicle, target, prediction and map in, a checked trajectory out.
#pragma once

#include <optional>

#include "core/fleet/use_fleet.hpp"
#include "core/planning/plan.hpp"
#include "core/planning/search/search_summary.hpp"
#include "foretrack_msgs/msg/FleetDivision.h"
#include "foretrack_msgs/msg/LocalMap.h"
#include "foretrack_msgs/msg/MovingBodies.h"
#include "foretrack_msgs/msg/PlannedTrajectory.h"
#include "foretrack_msgs/msg/SafetyState.h"
#include "foretrack_msgs/msg/TargetChoice.h"
#include "foretrack_msgs/msg/TargetIntention.h"
#include "foretrack_msgs/msg/TargetPrediction.h"
#include "foretrack_msgs/msg/TargetSearch.h"
#include "foretrack_msgs/msg/TargetState.h"
#include "nav_msgs/msg/Path.h"
#include "services/onboard/inputs.hpp"
#include "visualization_msgs/msg/MarkerArray.h"

namespace foretrack {

/// Plans on each prediction, and by a timer when none come: a plan says what is missing. A map with
/// stamp 0 is known and never too old.
class PlanningService {
 public:
  PlanningService(Service& service, const PlanningParams& params, const FleetParams& fleet);

 private:
  void replan();
  void believe(const IntentionAssessment& intention);
  void replan_if_late();
  PlanInput gather(double now_s);
  SeatPlace place_at(double now_s) const;
  std::string missing(const PlanInput& input) const;
  void publish(const PlanResult& result);
  void tell_search();
  void draw(const PlannedTrajectory& plan);

  Service& service_;
  PlanningParams params_;
  FleetParams fleet_params_;
  PlanningState state_;
  VehicleInput vehicle_;
  Reader<topics::LocalMap> map_reader_;
  Reader<topics::TargetState> target_reader_;
  Reader<topics::TargetIntention> intention_reader_;
  Reader<topics::TargetPrediction> prediction_reader_;
  Reader<topics::MovingBodies> bodies_reader_;
  Reader<topics::SafetyState> gate_reader_;
  Reader<topics::TargetChoice> choice_reader_;
  Reader<topics::FleetDivision> division_reader_;
  Reader<topics::FleetBodies> peers_reader_;
  Reader<topics::FleetTarget> told_reader_;
  Writer<topics::PlannedTrajectory> plan_;
  Writer<topics::TargetSearch> search_;
  Writer<topics::PlanPath> path_;
  Writer<topics::Markers> markers_;
  GridMap map_;
  TargetState target_;
  std::optional<IntentionAssessment> intention_;
  std::optional<Prediction> prediction_;
  std::optional<MovingBodies> bodies_;
  SeatPlace place_;  // in the fleet, as of then
  double placed_s_ = -1e9;
  MovingBodies peers_;
  MovingBodies kept_clear_;  // bodies and peers
  TargetState told_;         // where the others see the person
  bool flies_plans_ = true;  // until a gate says otherwise
  Framing framing_;          // as it was ordered
  bool waits_ = false;       // nobody is to be followed now, or an operator is asked who it is
  double planned_s_ = -1e9;
  double search_told_s_ = -1e9;
  SearchSummary summary_;
  DrawingPace drawing_;
};

/// Until the stop is requested.
void run_planning(const ServiceOptions& options, const PlanningParams& params,
                  const FleetParams& fleet, Stop& stop);

}  // namespace foretrack
