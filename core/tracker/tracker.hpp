// SPDX-License-Identifier: Apache-2.0
// One step through all stages, in lock-step and without DDS: what the benchmark, an embedder and
// the lock-step flight call. The stages meet here and nowhere else.
#pragma once

#include <limits>
#include <optional>

#include "core/bodies/bodies_around.hpp"
#include "core/choice/choose.hpp"
#include "core/fleet/coordinate.hpp"
#include "core/mapping/update_map.hpp"
#include "core/perception/perceive.hpp"
#include "core/perception/stream_params.hpp"
#include "core/planning/plan.hpp"
#include "core/prediction/predict.hpp"
#include "core/safety/gate.hpp"

namespace foretrack {

/// The parameters of all stages. Each struct has its rows(), which say what its fields mean.
struct TrackerParams {
  PerceptionParams perception;
  MappingParams mapping;
  BodyParams bodies;
  ChoiceParams choice;
  PredictionParams prediction;
  PlanningParams planning;
  SafetyParams safety;
  FleetParams fleet;
  StreamParams ground_stream;  ///< of the service that perceives; the tracker sends no pictures
};

/// A vehicle that flies with others, and what was heard of them since the last step.
struct FleetLink {
  ShortText vehicle, frame;  ///< names
  double battery = -1.0;     ///< of a full one; negative: not known
  std::span<const FleetMember> heard = {};
};

/// What is new at now_s. A null pointer: nothing of that kind came. What pointers lead to is read
/// during the step only.
struct TrackerInput {
  double now_s = 0.0;         ///< on the clock of all stamps; must grow from step to step
  VehicleState vehicle;       ///< the newest
  AutopilotStatus autopilot;  ///< the newest
  const TargetObservation* observation = nullptr;
  /// Depth of the torso's surface in the observation's image, along the optical axis (see
  /// torso_surface_depth_m()). NaN: not measured.
  double torso_depth_m = std::numeric_limits<double>::quiet_NaN();
  std::optional<Appearance> wears = {};  ///< the person in the observation's image; none: not seen
  const DepthImage* depth = nullptr;
  const GridMap* known_map = nullptr;        ///< null: plans are made in the map built from depth
  const BodySightings* sightings = nullptr;  ///< of others, by a detector; empty: of nobody
  std::span<const PersonLook> looks = {};    ///< of the sightings one by one; may be empty
  const MissionCommand* command = nullptr;   ///< an operator's order
  const FleetLink* fleet = nullptr;          ///< null: it flies alone
};

/// All that is kept from step to step. One for each vehicle.
struct TrackerState {
  /// Throws std::invalid_argument on bad mapping parameters.
  explicit TrackerState(const TrackerParams& params);
  VehicleHistory vehicles;
  PerceptionState perception;
  MappingState mapping;
  BodiesState bodies;
  ChoiceState choice;
  std::optional<std::uint32_t> follow_order;              ///< that was taken in the last step
  std::array<PersonLook, MovingBodies::kCapacity> looks;  ///< of around
  MovingBodies around;                                    ///< at the last step
  MovingBodies kept_clear;                                ///< the same with the fleet's others
  PredictionState prediction;
  PlanningState planning;
  GateState gate;
  FleetState fleet;
  FleetResult coordinated;     ///< at the last step of the fleet
  double delay_s = 0.0;        ///< age of the newest observation when it came
  double next_plan_s = -1.0;   ///< no plan is made earlier
  double next_fleet_s = -1.0;  ///< nothing is told earlier
};

/// What the stages say in this step. The pointers lead into the state (or to the known map) and are
/// valid until the next step.
struct TrackerOutput {
  TargetState target;                            ///< predicted on to now_s
  const PredictionResult* prediction = nullptr;  ///< null: none was made in this step
  const PlanResult* plan = nullptr;              ///< null: none was made in this step
  const GridMap* map = nullptr;          ///< that plans are made in; null: there is none yet
  const MovingBodies* bodies = nullptr;  ///< around the vehicle, the followed person among them
  const FleetResult* fleet = nullptr;    ///< null: nothing was told in this step
  ChoiceResult choice;                   ///< who is followed, and how sure that is
  bool planned = false;                  ///< prediction and plan were made in this step
  GateResult gate;                       ///< what the flight controller is to be given
};

/// perceive → update map → track bodies → coordinate → predict → choose → plan → gate. Predictions
/// and plans are made once in planning.horizon.plan_period_s, as soon as there is a map. Call it at
/// the gate's rate (100 Hz). Cost: some microseconds; with an observation 40 µs, with a depth image
/// 5 ms, with a plan 1 ms more. Allocates nothing after the first seconds in a known map.
TrackerOutput step(TrackerState& state, const TrackerInput& input, const TrackerParams& params);

}  // namespace foretrack
