// SPDX-License-Identifier: Apache-2.0
// Images or observations, sightings of others, and odometry in; the target's state and all bodies
// around out.
#pragma once

#include <deque>
#include <optional>

#include "core/tracker/follow_people.hpp"
#include "foretrack_msgs/msg/BodySightings.h"
#include "foretrack_msgs/msg/MovingBodies.h"
#include "foretrack_msgs/msg/SafetyState.h"
#include "foretrack_msgs/msg/TargetObservation.h"
#include "foretrack_msgs/msg/TargetPrediction.h"
#include "foretrack_msgs/msg/TargetState.h"
#include "services/convert/safety.hpp"
#include "services/onboard/inputs.hpp"
#include "services/onboard/perception/choice_teller.hpp"
#include "services/onboard/perception/image_input.hpp"
#include "visualization_msgs/msg/MarkerArray.h"

namespace foretrack {

/// Publishes at each observation, stamped with its image; while none come, it coasts at 30 Hz to
/// where observations would be now (now less their usual delay), so that stamps never go back. What
/// it sees in images it publishes as observations too. With each state it publishes the bodies
/// around, extrapolated to the newest sensor data, and chooses whom to follow: by an order that the
/// safety gate has taken, else as choose() says.
class PerceptionService {
 public:
  PerceptionService(Service& service, const PerceptionParams& params, const BodyParams& body_params,
                    const ChoiceParams& choice_params, const StreamParams& stream);

 private:
  struct Waiting {
    TargetObservation observation;
    double arrived_s = 0.0;
    double torso_depth_m = 0.0;  // NaN: not measured
    bool own = false;            // of our own images
    std::optional<Appearance> wears = {};
  };
  void take(const foretrack_msgs::msg::TargetObservation& message);
  void take_seen(const ImageInput::Seen& seen);
  void wait_for_odometry(Waiting observed);
  void perceive_waiting();
  void coast_if_silent();
  void publish(const TargetState& target);
  void take_sightings(const BodySightings& seen, std::span<const PersonLook> looks);
  void publish_bodies(const TargetState& target);
  void hear_gate(const GateReport& gate);
  void choose_whom(double stamp_s);
  PeopleTracks people() { return {state_, bodies_state_, choice_}; }
  PeopleParams people_params() const { return {params_, body_params_, choice_params_}; }
  void publish_markers(const TargetState& target);

  Service& service_;
  PerceptionParams params_;
  BodyParams body_params_;
  ChoiceParams choice_params_;
  PerceptionState state_;
  BodiesState bodies_state_;
  ChoiceState choice_;
  std::optional<PersonChoice> ordered_;  // as the gate said last
  std::uint64_t order_id_ = 0;           // of the last order to follow
  std::optional<std::uint32_t> order_;   // that is to be followed
  bool doubtful_ = false;                // the last image leaves a doubt who is who
  VehicleInput vehicle_;
  Reader<topics::TargetObservation> observation_;
  std::optional<Writer<topics::TargetObservation>> seen_;  // of images, once some come
  Reader<topics::BodySightings> sightings_;
  Reader<topics::TargetPrediction> prediction_reader_;
  Reader<topics::SafetyState> gate_reader_;
  Writer<topics::TargetState> target_;
  Writer<topics::MovingBodies> bodies_;
  ChoiceTeller choice_teller_;
  Writer<topics::Markers> markers_;
  Prediction prediction_;
  MovingBodies around_;
  std::array<PersonLook, MovingBodies::kCapacity> looks_;
  std::deque<Waiting> waiting_;  // for the odometry of their stamps
  double delay_s_ = 0.0;         // of the last observation
  double published_s_ = -1.0;    // stamp of the last usable state
  DrawingPace drawing_;
  double looked_s_ = -1e9;  // stamp of the last image that was looked at
  std::uint32_t gated_ = 0;
  ImageInput images_;
};

/// Until the stop is requested.
void run_perception(const ServiceOptions& options, const PerceptionParams& params,
                    const BodyParams& body_params, const ChoiceParams& choice_params,
                    const StreamParams& stream, Stop& stop);

}  // namespace foretrack
