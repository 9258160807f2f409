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
#include "px4_msgs/msg/VehicleStatus.h"
#include "rosgraph_msgs/msg/Clock.h"
#include "sensor_msgs/msg/CameraInfo.h"
#include "sensor_msgs/msg/CompressedImage.h"
#include "sensor_msgs/msg/Image.h"
#include "services/common/node.hpp"
#include "services/common/rate.hpp"
#include "services/common/reader.hpp"
#include "services/common/topics.hpp"
#include "services/convert/depth_reader.hpp"
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
  /// with_images: also the images and the local map, which are large.
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
  /// Cameras as the services read them: what they refuse does not count as coming.
  struct Cameras {
    explicit Cameras(Node& node)
        : color(node),
          compressed(node),
          color_info(node),
          depth(node),
          depth_info(node),
          map(node) {}
    Reader<topics::ColorImage> color;
    Reader<topics::ColorImageCompressed> compressed;
    Reader<topics::ColorCameraInfo> color_info;
    Reader<topics::DepthImage> depth;
    Reader<topics::DepthCameraInfo> depth_info;
    Reader<topics::LocalMap> map;
    std::optional<CameraWithLens> color_camera;
    std::optional<CameraWithLens> depth_camera;
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
  void take_inputs();
  void take_images(Cameras& cameras);
  template <class Topic, class Convert, class Take>
  void take_as(Reader<Topic>& reader, Convert convert, Take take);
  void fill_inputs(FlightSnapshot& p) const;
  void hear(const foretrack_msgs::msg::ServiceHealth& health);

  Node& node_;
  Kept<topics::Odometry> odometry_;
  Reader<topics::TargetObservation> observation_;
  std::optional<Reader<topics::ColorCameraInfo>> color_info_;  // unless the cameras are watched
  std::optional<Cameras> cameras_;
  Reader<topics::Px4VehicleStatus> px4_status_;
  double px4_ahead_s_ = 0.0;
  bool nobody_in_images_ = false;
  Kept<topics::TargetState> target_;
  Kept<topics::TargetIntention> intention_;
  Kept<topics::TargetPrediction> prediction_;
  Kept<topics::PlannedTrajectory> plan_;
  Kept<topics::SafetyState> safety_;
  Reader<topics::ServiceHealth> health_;
  Reader<topics::Clock> simulated_clock_;
  Kept<topics::VehicleTruth> vehicle_truth_;
  Kept<topics::TargetTruth> target_truth_;
  std::vector<Slot> slots_;
  std::map<std::string, std::string> refusals_;  // the last one in words, by the topic's wire name
  std::map<std::string, Heard> services_;
  double simulated_s_ = -1.0;  // negative: no simulated clock is heard
  RateMeter simulated_ms_;
  double time_rate_ = -1.0;
  bool map_is_static_ = false;
};

}  // namespace foretrack
