// SPDX-License-Identifier: Apache-2.0
#include "services/operator/topic_watch.hpp"

#include <algorithm>
#include <memory>

#include "diagnostic_msgs/msg/DiagnosticArray.h"
#include "foretrack_msgs/msg/BodySightings.h"
#include "foretrack_msgs/msg/FleetDivision.h"
#include "foretrack_msgs/msg/FleetMember.h"
#include "foretrack_msgs/msg/LocalMap.h"
#include "foretrack_msgs/msg/MissionCommand.h"
#include "foretrack_msgs/msg/MovingBodies.h"
#include "foretrack_msgs/msg/TargetChoice.h"
#include "foretrack_msgs/msg/TargetObservation.h"
#include "foretrack_msgs/msg/TargetSearch.h"
#include "foxglove_msgs/msg/CompressedVideo.h"
#include "nav_msgs/msg/Path.h"
#include "octomap_msgs/msg/Octomap.h"
#include "px4_msgs/msg/ArmingCheckReply.h"
#include "px4_msgs/msg/ArmingCheckRequest.h"
#include "px4_msgs/msg/BatteryStatus.h"
#include "px4_msgs/msg/FailsafeFlags.h"
#include "px4_msgs/msg/HomePosition.h"
#include "px4_msgs/msg/ManualControlSetpoint.h"
#include "px4_msgs/msg/ModeCompleted.h"
#include "px4_msgs/msg/OffboardControlMode.h"
#include "px4_msgs/msg/RegisterExtComponentReply.h"
#include "px4_msgs/msg/RegisterExtComponentRequest.h"
#include "px4_msgs/msg/TimesyncStatus.h"
#include "px4_msgs/msg/TrajectorySetpoint.h"
#include "px4_msgs/msg/UnregisterExtComponent.h"
#include "px4_msgs/msg/VehicleCommand.h"
#include "px4_msgs/msg/VehicleCommandAck.h"
#include "px4_msgs/msg/VehicleControlMode.h"
#include "px4_msgs/msg/VehicleLocalPosition.h"
#include "px4_msgs/msg/VehicleOdometry.h"
#include "px4_msgs/msg/VehicleStatus.h"
#include "rcl_interfaces/msg/Log.h"
#include "rcl_interfaces/msg/ParameterEvent.h"
#include "rosgraph_msgs/msg/Clock.h"
#include "sensor_msgs/msg/CameraInfo.h"
#include "sensor_msgs/msg/CompressedImage.h"
#include "sensor_msgs/msg/Image.h"
#include "sensor_msgs/msg/PointCloud2.h"
#include "services/common/reader.hpp"
#include "services/common/topics.hpp"
#include "tf2_msgs/msg/TFMessage.h"
#include "visualization_msgs/msg/MarkerArray.h"

namespace foretrack {

TopicFlow flow_of(std::string_view topic, const EndpointStats& stats, double rate_hz) {
  TopicFlow flow;
  flow.topic = topic;
  flow.wire = stats.topic;
  flow.rate_hz = rate_hz;
  flow.age_s = stats.age_s();
  flow.writers = stats.peers;
  flow.samples = stats.samples;
  flow.incompatible_qos = stats.incompatible_qos;
  flow.rejected = stats.rejected;
  return flow;
}

template <class Topic>
void TopicWatch::watch() {
  auto reader = std::make_shared<Reader<Topic>>(node_);
  slots_.push_back(
      {std::string(Topic::info.name), &reader->stats(), [reader] { reader->take_newest(); }, {}});
}

TopicWatch::TopicWatch(Node& node) : node_(node) {
  [this]<class... Topic>(std::tuple<Topic...>*) {
    (watch<Topic>(), ...);
  }(static_cast<topics::All*>(nullptr));
}

void TopicWatch::update() {
  const double now_s = node_.clock().steady_s();
  for (auto& slot : slots_) {
    slot.take();
    slot.rate_hz = slot.meter.update(slot.stats->samples, now_s);
  }
}

std::vector<TopicFlow> TopicWatch::flows() const {
  std::vector<TopicFlow> flows;
  const auto endpoints = node_.endpoints();
  for (const auto& slot : slots_) {
    auto& flow = flows.emplace_back(flow_of(slot.topic, *slot.stats, slot.rate_hz));
    flow.readers = static_cast<int>(
        std::count_if(endpoints.begin(), endpoints.end(),
                      [&](const ForeignEndpoint& e) { return !e.writes && e.topic == flow.wire; }));
  }
  return flows;
}

}  // namespace foretrack
