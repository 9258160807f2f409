// SPDX-License-Identifier: Apache-2.0
// What cameras see of a scenario from a vehicle, and the truth, on the bus.
#pragma once

#include <optional>
#include <string>

#include "core/simulator/simulate.hpp"
#include "foretrack_msgs/msg/BodySightings.h"
#include "foretrack_msgs/msg/LocalMap.h"
#include "foretrack_msgs/msg/TargetObservation.h"
#include "nav_msgs/msg/Odometry.h"
#include "sensor_msgs/msg/CameraInfo.h"
#include "sensor_msgs/msg/Image.h"
#include "services/common/service.hpp"
#include "tf2_msgs/msg/TFMessage.h"

namespace foretrack {

class SceneWriter {
 public:
  /// Publishes the camera's mount, latched.
  SceneWriter(Node& node, const Scenario& scenario);

  /// If the scenario's map is known: latched, once.
  void publish_map(const Scenario& scenario, const World& world);
  void publish_cameras(const SimulatorOutput& out);
  void publish_truth(const SimulatorOutput& out);
  const std::string& body_frame() const { return body_frame_; }

 private:
  const std::string body_frame_, camera_frame_;
  std::optional<Writer<topics::TargetObservation>> observation_;  // not beside images
  std::optional<Writer<topics::BodySightings>> sightings_;        // the same
  Writer<topics::DepthImage> depth_;
  Writer<topics::DepthCameraInfo> camera_info_;
  Writer<topics::ColorImage> color_;
  Writer<topics::ColorCameraInfo> color_info_;
  Writer<topics::TargetTruth> target_truth_;
  Writer<topics::VehicleTruth> vehicle_truth_;
  Writer<topics::StaticTransforms> mount_;
  Writer<topics::LocalMap> map_;
};

}  // namespace foretrack
