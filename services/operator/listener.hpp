// SPDX-License-Identifier: Apache-2.0
// Hears one vehicle's topics and keeps the newest of each.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "foretrack_msgs/msg/LocalMap.h"
#include "foretrack_msgs/msg/TargetObservation.h"
#include "rosgraph_msgs/msg/Clock.h"
#include "sensor_msgs/msg/CameraInfo.h"
#include "sensor_msgs/msg/Image.h"
#include "services/common/node.hpp"
#include "services/common/rate.hpp"
#include "services/common/reader.hpp"
#include "services/common/topics.hpp"
#include "services/operator/flight_snapshot.hpp"

namespace foretrack {

/// Called with every valid sample, in order of arrival; empty ones are skipped.
struct Hooks {
  std::function<void(double stamp_s)> color_image;  // its camera_info came
  std::function<void(const nav_msgs::msg::Odometry&)> vehicle_truth, target_truth;
  std::function<void(const foretrack_msgs::msg::TargetState&)> target;
  std::function<void(const foretrack_msgs::msg::TargetIntention&)> intention;
  std::function<void(const foretrack_msgs::msg::TargetPrediction&)> prediction;
  std::function<void(const foretrack_msgs::msg::PlannedTrajectory&)> plan;
  std::function<void(const foretrack_msgs::msg::SafetyState&)> safety;
};

class Listener {
 public:
  /// with_images: also the depth images and the local map, which are large.
  Listener(Node& node, bool with_images);

  /// Takes all that came. Call it twenty times a second: readers keep few samples.
  void update();
  FlightSnapshot snapshot();

  Hooks hooks;

 private:
  struct Slot {
    std::string_view topic;
    const EndpointStats* stats;
    RateMeter meter;
    double rate_hz = 0.0;
  };
  struct Heard {
    ServiceReport report;
    double at_s = 0.0;  // steady
  };
  /// A reader, and the newest sample that it gave.
  template <class Topic>
  struct Kept {
    explicit Kept(Node& node) : reader(node) {}
    template <class Hook>
    void take(const Hook& hook);
    const typename Topic::Type* newest() const { return any ? &sample : nullptr; }

    Reader<Topic> reader;
    typename Topic::Type sample;
    bool any = false;
  };
  template <class Topic>
  void watch(const Reader<Topic>& reader);
  void take_images();
  void hear(const foretrack_msgs::msg::ServiceHealth& health);

  Node& node_;
  Kept<topics::Odometry> odometry_;
  Reader<topics::TargetObservation> observation_;
  Reader<topics::ColorCameraInfo> color_info_;
  std::optional<Reader<topics::DepthImage>> depth_;
  Kept<topics::TargetState> target_;
  std::optional<Reader<topics::LocalMap>> map_;
  Kept<topics::TargetIntention> intention_;
  Kept<topics::TargetPrediction> prediction_;
  Kept<topics::PlannedTrajectory> plan_;
  Kept<topics::SafetyState> safety_;
  Reader<topics::ServiceHealth> health_;
  Reader<topics::Clock> simulated_clock_;
  Kept<topics::VehicleTruth> vehicle_truth_;
  Kept<topics::TargetTruth> target_truth_;
  std::vector<Slot> slots_;
  std::map<std::string, Heard> services_;
  double simulated_s_ = -1.0;  // negative: no simulated clock is heard
  RateMeter simulated_ms_;
  double time_rate_ = -1.0;
  bool map_is_static_ = false;
};

}  // namespace foretrack
