// SPDX-License-Identifier: Apache-2.0
// Depth images and odometry in, the map around the vehicle and what moves in it out.
#pragma once

#include <optional>

#include "core/common/target.hpp"
#include "core/mapping/update_map.hpp"
#include "foretrack_msgs/msg/BodySightings.h"
#include "foretrack_msgs/msg/LocalMap.h"
#include "foretrack_msgs/msg/MovingBodies.h"
#include "octomap_msgs/msg/Octomap.h"
#include "sensor_msgs/msg/CameraInfo.h"
#include "sensor_msgs/msg/Image.h"
#include "sensor_msgs/msg/PointCloud2.h"
#include "services/convert/depth_reader.hpp"
#include "services/onboard/camera_mount.hpp"
#include "services/onboard/camera_sight.hpp"
#include "services/onboard/inputs.hpp"

namespace foretrack {

/// Publishes the local map at up to 10 Hz, stamped with the newest image in it, and what moves at
/// each image. The octree and the occupied cells are published once a second, while somebody asks
/// for them. The camera's mount is that of the image's frame at its stamp: see CameraMount.
class MappingService {
 public:
  MappingService(Service& service, const MappingParams& params);

 private:
  void take(const sensor_msgs::msg::Image& message);
  bool place(const VehicleState* vehicle);
  Fault what_is_missing();
  void update();
  void publish();
  void publish_for_others();
  void watch();

  Service& service_;
  MappingParams params_;
  MappingState state_;
  VehicleInput vehicle_;
  CameraSight sight_;
  Reader<topics::DepthImage> image_;
  Reader<topics::DepthCameraInfo> info_;
  Reader<topics::MovingBodies> bodies_reader_;
  TransformInput transforms_;
  CameraMount mount_;
  Writer<topics::LocalMap> map_;
  Writer<topics::BodySightings> sightings_;
  Writer<topics::OctoMap> octree_;
  Writer<topics::MapPoints> points_;
  std::optional<DepthReader> camera_;
  MovingBodies bodies_;
  DepthImage depth_;
  std::string frame_id_;  // of depth_
  bool waiting_ = false;  // depth_ waits for the odometry of its stamp
  double arrived_s_ = -1e9;
  double published_s_ = -1e9;
};

/// Until the stop is requested.
void run_mapping(const ServiceOptions& options, const MappingParams& params, Stop& stop);

}  // namespace foretrack
