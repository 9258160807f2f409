// Hears one vehicle's topics and keeps the newest of each.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "foretrack_msgs/msg/LocalMap.h"
#include "foretrack_msgs/msg/TargetObservation.h"
#include "sensor_msgs/msg/Image.h"
#include "services/common/node.hpp"
#include "services/common/reader.hpp"
#include "services/common/topics.hpp"
#include "services/ground_station/picture.hpp"
#include "services/ground_station/rate.hpp"

namespace foretrack {

/// Called with every valid sample, in order of arrival; empty ones are skipped.
struct Hooks {
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
  Picture picture();

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
  template <class Topic>
  void watch(const Reader<Topic>& reader);
  void hear(const foretrack_msgs::msg::ServiceHealth& health);
  TopicFlow flow_of(const Slot& slot) const;

  Node& node_;
  Reader<topics::Odometry> odometry_;
  Reader<topics::TargetObservation> observation_;
  std::optional<Reader<topics::DepthImage>> depth_;
  Reader<topics::TargetState> target_;
  std::optional<Reader<topics::LocalMap>> map_;
  Reader<topics::TargetIntention> intention_;
  Reader<topics::TargetPrediction> prediction_;
  Reader<topics::PlannedTrajectory> plan_;
  Reader<topics::SafetyState> safety_;
  Reader<topics::ServiceHealth> health_;
  Reader<topics::VehicleTruth> vehicle_truth_;
  Reader<topics::TargetTruth> target_truth_;
  std::vector<Slot> slots_;
  std::map<std::string, Heard> services_;
};

}  // namespace foretrack
