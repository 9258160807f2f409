// SPDX-License-Identifier: Apache-2.0
// The target's state and the map in, intentions and predicted paths out.
#pragma once

#include "core/prediction/predict.hpp"
#include "foretrack_msgs/msg/LocalMap.h"
#include "foretrack_msgs/msg/TargetIntention.h"
#include "foretrack_msgs/msg/TargetPrediction.h"
#include "foretrack_msgs/msg/TargetState.h"
#include "nav_msgs/msg/Path.h"
#include "services/onboard/inputs.hpp"
#include "visualization_msgs/msg/MarkerArray.h"

namespace foretrack {

/// Publishes at each target state, stamped as it is. Without one for the parameter
/// target_stale_s it says so: a prediction without paths, five times a second.
class PredictionService {
 public:
  PredictionService(Service& service, const PredictionParams& params);

 private:
  void predict_from(const TargetState& target);
  void declare_if_silent();
  void draw();

  Service& service_;
  PredictionParams params_;
  PredictionState state_;
  Reader<topics::LocalMap> map_reader_;
  Reader<topics::TargetState> target_;
  Reader<topics::FleetTarget> told_reader_;
  Writer<topics::TargetIntention> intention_;
  Writer<topics::TargetPrediction> prediction_;
  Writer<topics::PredictionPath> path_;
  Writer<topics::Markers> markers_;
  GridMap map_;
  TargetState told_;  // where the others of a fleet see the person
  double taken_s_ = -1e9;
  DrawingPace drawing_;
};

/// Until the stop is requested.
void run_prediction(const ServiceOptions& options, const PredictionParams& params, Stop& stop);

}  // namespace foretrack
