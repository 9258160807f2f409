// SPDX-License-Identifier: Apache-2.0
// One step through all stages, in lock-step and without DDS: what the benchmark, an embedder and
// the lock-step flight call. The stages meet here and nowhere else.
#pragma once

#include <limits>

#include "core/mapping/update_map.hpp"
#include "core/perception/perceive.hpp"
#include "core/planning/plan.hpp"
#include "core/prediction/predict.hpp"
#include "core/safety/gate.hpp"

namespace foretrack {

struct TrackerParams {
  PerceptionParams perception;
  MappingParams mapping;
  PredictionParams prediction;
  PlanningParams planning;
  SafetyParams safety;
};

/// What is new at now_s. Null: nothing of that kind came.
struct TrackerInput {
  double now_s = 0.0;
  VehicleState vehicle;
  AutopilotStatus autopilot;
  const TargetObservation* observation = nullptr;
  double torso_depth_m = std::numeric_limits<double>::quiet_NaN();  // with it; NaN: not measured
  const DepthImage* depth = nullptr;
  const GridMap* known_map = nullptr;    // null: the map is built from depth
  const MovingBodies* bodies = nullptr;  // people and vehicles around, as last seen; null: nobody
  const MissionCommand* command = nullptr;
};

struct TrackerState {
  explicit TrackerState(const TrackerParams& params);
  VehicleHistory vehicles;
  PerceptionState perception;
  MappingState mapping;
  PredictionState prediction;
  PlanningState planning;
  GateState gate;
  double delay_s = 0.0;  // age of the newest observation when it came
  double next_plan_s = -1.0;
  std::uint64_t last_plan_id = 0;
};

/// What every stage said last. The pointers are into the state, null before the stage first ran.
struct TrackerOutput {
  TargetState target;
  const PredictionResult* prediction = nullptr;
  const PlanResult* plan = nullptr;
  const GridMap* map = nullptr;
  bool planned = false;  // a plan was made in this step
  GateResult gate;
};

/// perceive → update map → predict → plan → gate. Call it at the gate's rate (100 Hz).
/// Precondition: now_s grows.
TrackerOutput step(TrackerState& state, const TrackerInput& input, const TrackerParams& params);

}  // namespace foretrack
