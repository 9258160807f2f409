// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/mapping/mapping_service.hpp"

#include "core/common/random.hpp"
#include "services/convert/bodies.hpp"
#include "services/convert/image.hpp"
#include "services/convert/map.hpp"
#include "services/convert/transforms.hpp"
#include "tests/services/onboard/neighbours.hpp"

namespace foretrack::testing {
namespace {

class MappingOnDds : public ::testing::Test {
 protected:
  explicit MappingOnDds(std::vector<double> mount = {}) : mount_(std::move(mount)) {
    neighbours_.vehicle.position_enu_m = {0.0, 0.0, 1.5};
    wall_.camera = CameraModel::from_fov(80, 60, rad(90.0), rad(75.0));
    wall_.depth_m.assign(80 * 60, 2.0f);
  }
  void send_image() {
    wall_.stamp_s = neighbours_.now_s();
    to_idl(wall_, image_.sample(), frame_id_);
    image_.write();
  }
  /// That the service says of itself.
  bool health_says(const std::string& words) {
    health_.take_each([&](const foretrack_msgs::msg::ServiceHealth& message) {
      using foretrack_msgs::msg::ServiceHealth_Constants::STATE_DEGRADED;
      said_ = message.state() == STATE_DEGRADED ? message.last_error().c_str() : "nothing";
    });
    return said_.find(words) != std::string::npos;
  }
  void feed() {
    to_idl(wall_.camera, neighbours_.now_s(), info_.sample());
    info_.write();
    neighbours_.send_odometry();
    send_image();
  }
  bool maps() {
    map_reader_.take_each([this](const auto& message) {
      auto map = from_idl(message);
      ASSERT_TRUE(map) << map.fault().text;
      map_ = std::move(*map);
    });
    return !map_.empty();
  }

  const std::vector<double> mount_;
  std::string frame_id_ = kCameraFrame, said_;
  Neighbours neighbours_;
  Reader<topics::ServiceHealth> health_{neighbours_.node()};
  Writer<topics::DepthImage> image_{neighbours_.node()};
  Writer<topics::DepthCameraInfo> info_{neighbours_.node()};
  Reader<topics::LocalMap> map_reader_{neighbours_.node()};
  Running service_{[this](const ServiceOptions& options, Stop& stop) {
    ServiceOptions own = options;
    own.depth_mount = mount_;
    run_mapping(own, MappingParams{}, stop);
  }};
  DepthImage wall_;  // a wall 2 m ahead
  GridMap map_;
};

TEST_F(MappingOnDds, MapsAWall) {
  ASSERT_TRUE(neighbours_.until(
      [&] {
        return maps() && map_.is_occupied({2.0, 0.0, 1.5});
      },
      [&] { feed(); }));
  EXPECT_EQ(map_.cell_at({1.0, 0.0, 1.5}), Cell::kFree);
  EXPECT_EQ(map_.cell_at({3.0, 0.0, 1.5}), Cell::kUnknown);
}

TEST_F(MappingOnDds, WhatAPersonCoversIsNoWallAndEveryImageSaysWhoMoves) {
  Writer<topics::MovingBodies> bodies(neighbours_.node());
  Reader<topics::BodySightings> sightings(neighbours_.node());
  ASSERT_TRUE(neighbours_.until(
      [&] {
        const auto* message = sightings.take_newest();
        return maps() && map_.is_occupied({2.0, 1.0, 1.5}) &&
               map_.cell_at({2.0, 0.0, 1.5}) != Cell::kOccupied && message && from_idl(*message);
      },
      [&] {
        MovingBodies around;
        around.stamp_s = neighbours_.now_s();
        MovingBody person;
        person.kind = BodyKind::kPerson;
        person.position_enu_m = {2.0, 0.0, 0.0};
        around.add(person);
        to_idl(around, {}, bodies.sample());
        bodies.write();
        feed();
      }));
}

TEST_F(MappingOnDds, SaysWithTheMapWhenDepthIsFrozenOrCovered) {
  namespace m = foretrack_msgs::msg::LocalMap_Constants;
  Random random(1);
  std::uint8_t said = m::CAMERA_SEES;
  const auto says = [&](std::uint8_t wanted, const std::function<float()>& depth_m) {
    return neighbours_.until(
        [&] {
          map_reader_.take_each([&](const auto& message) { said = message.camera(); });
          return said == wanted;
        },
        [&] {
          neighbours_.vehicle.position_enu_m.y() += 0.05;
          std::ranges::generate(wall_.depth_m, depth_m);
          feed();
        });
  };
  const auto wall = [&] { return static_cast<float>(random.uniform(1.9, 2.1)); };
  EXPECT_TRUE(says(m::CAMERA_FROZEN, [] { return 2.0F; }));
  EXPECT_TRUE(says(m::CAMERA_SEES, wall));
  EXPECT_TRUE(says(m::CAMERA_COVERED, [] { return 0.0F; }));
  EXPECT_TRUE(says(m::CAMERA_SEES, wall));
}

TEST_F(MappingOnDds, GivesItsOctreeToWhoAsks) {
  Reader<topics::OctoMap> octree(neighbours_.node());
  ASSERT_TRUE(neighbours_.until(
      [&] {
        const auto* message = octree.take_newest();
        return message && message->id() == "OcTree" && !message->data().empty();
      },
      [&] { feed(); }));
}

TEST_F(MappingOnDds, RefusesImagesWithoutCameraOrOdometry) {
  const std::string topic = "camera/depth/image";
  ASSERT_TRUE(neighbours_.until([&] { return neighbours_.refused(topic, "camera_info") > 0; },
                                [&] { send_image(); }));
  ASSERT_TRUE(neighbours_.until([&] { return neighbours_.refused(topic, "odometry") > 0; },
                                [&] {
                                  to_idl(wall_.camera, neighbours_.now_s(), info_.sample());
                                  info_.write();
                                  send_image();
                                }));
  EXPECT_FALSE(maps());
}

TEST_F(MappingOnDds, RefusesGarbageAndGoesOn) {
  ASSERT_TRUE(neighbours_.until([&] { return maps(); }, [&] { feed(); }));
  const auto send_garbage = [&] {
    send_image();
    image_.sample().data().resize(17);
    image_.write();
    send_image();
    image_.sample().width(4'000'000'000u);
    image_.write();
    send_image();
    image_.sample().encoding("rgb8");
    image_.write();
    info_.sample().k()[0] = kNaN;
    info_.write();
  };
  ASSERT_TRUE(neighbours_.until(
      [&] {
        return neighbours_.refused("camera/depth/image") >= 3 &&
               neighbours_.refused("camera/depth/camera_info") >= 1;
      },
      send_garbage));
  const double stamp_s = map_.stamp_s;
  EXPECT_TRUE(
      neighbours_.until([&] { return maps() && map_.stamp_s > stamp_s + 0.5; }, [&] { feed(); }));
}

Pose turned_left() {
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(kPi / 2.0, Vec3::UnitZ()).toRotationMatrix();
  return pose;
}

TEST_F(MappingOnDds, AMountThatNobodyKnowsIsSaid) {
  EXPECT_TRUE(neighbours_.until(
      [&] { return maps() && health_says("camera_optical_frame' sits is not known"); },
      [&] { feed(); }))
      << said_;
}

// As drivers publish it: the image's frame is the last of a chain, and another vehicle has a frame
// of the same name on the shared topic.
TEST_F(MappingOnDds, TheMountIsTheChainFromTheImagesFrame) {
  frame_id_ = "camera_depth_optical_frame";
  Writer<topics::StaticTransforms> transforms(neighbours_.node());
  const auto send = [&](const Pose& pose, const char* parent, const char* child) {
    to_transform(pose, parent, child, 0.0, transforms.sample());
    transforms.write();
  };
  ASSERT_TRUE(neighbours_.until(
      [&] {
        return maps() && map_.is_occupied({0.0, 2.0, 1.5});
      },
      [&] {
        send(turned_left(), "base_link", "camera_link");
        send(CameraModel::default_mount(), "camera_link", "camera_depth_optical_frame");
        send(CameraModel::default_mount(), "uav2/base_link", "uav2/camera_depth_optical_frame");
        feed();
      }));
  EXPECT_TRUE(neighbours_.until([&] { return health_says("nothing"); }, [&] { feed(); })) << said_;
}

TEST_F(MappingOnDds, AJointCountsAtTheImagesStampAndWithoutItNoImageCounts) {
  frame_id_ = "gimbal_camera";
  Writer<topics::Transforms> joints(neighbours_.node());
  const auto send_joint = [&](double age_s) {
    to_transform(turned_left() * CameraModel::default_mount(), "uav1/base_link", "gimbal_camera",
                 neighbours_.now_s() - age_s, joints.sample());
    joints.write();
  };
  ASSERT_TRUE(neighbours_.until(
      [&] {
        return maps() && map_.is_occupied({0.0, 2.0, 1.5});
      },
      [&] {
        send_joint(0.0);
        feed();
      }));
  EXPECT_TRUE(neighbours_.until(
      [&] { return neighbours_.refused("camera/depth/image", "mount") > 0; }, [&] { feed(); }));
}

class MappingWithAMount : public MappingOnDds {
 protected:
  MappingWithAMount() : MappingOnDds({0.0, 0.0, 0.0, 0.0, 0.0, kPi / 2.0}) {}
};

TEST_F(MappingWithAMount, TheConfigurationComesBeforeTransforms) {
  EXPECT_TRUE(neighbours_.until(
      [&] {
        return maps() && map_.is_occupied({0.0, 2.0, 1.5});
      },
      [&] { feed(); }));
}

TEST_F(MappingOnDds, OdometryOfAnotherFrameIsBroughtIntoTheMap) {
  Writer<topics::Transforms> transforms(neighbours_.node());
  Pose T_map_odom = turned_left();
  ASSERT_TRUE(neighbours_.until(
      [&] {
        return maps() && map_.is_occupied({0.0, 2.0, 1.5});
      },
      [&] {
        to_transform(T_map_odom, "map", "odom", neighbours_.now_s(), transforms.sample());
        transforms.write();
        to_idl(wall_.camera, neighbours_.now_s(), info_.sample());
        info_.write();
        neighbours_.vehicle.stamp_s = neighbours_.now_s();
        auto& odometry = neighbours_.odometry();
        to_idl(neighbours_.vehicle, odometry.sample());
        odometry.sample().header().frame_id("odom");
        odometry.write();
        send_image();
      }));
}

}  // namespace
}  // namespace foretrack::testing
