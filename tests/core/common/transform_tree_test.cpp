// SPDX-License-Identifier: Apache-2.0
#include "core/common/transform_tree.hpp"

#include <gmock/gmock.h>

#include "core/common/camera.hpp"

namespace foretrack {
namespace {

using testing::HasSubstr;
using Status = TransformTree::Status;
using Added = TransformTree::Added;

Pose at(const Vec3& place_m, double yaw_rad = 0.0, double pitch_rad = 0.0) {
  Pose pose = Pose::Identity();
  pose.translation() = place_m;
  pose.linear() =
      (Eigen::AngleAxisd(yaw_rad, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch_rad, Vec3::UnitY()))
          .toRotationMatrix();
  return pose;
}

TEST(TransformTree, AChainIsTheProductOfItsTransforms) {
  TransformTree tree;
  tree.add_static("base_link", "camera_link", at({0.2, 0.0, 0.1}, 0.3));
  tree.add_static("camera_link", "camera_color_frame", at({0.0, 0.015, 0.0}));
  tree.add_static("camera_color_frame", "camera_color_optical_frame", CameraModel::default_mount());
  const auto found = tree.find("base_link", "camera_color_optical_frame", 5.0);
  ASSERT_EQ(found.status, Status::kFound);
  EXPECT_FALSE(found.moves);
  EXPECT_TRUE(found.T_to_from.isApprox(at({0.2, 0.0, 0.1}, 0.3) * at({0.0, 0.015, 0.0}) *
                                       CameraModel::default_mount()));
  const auto back = tree.find("camera_color_optical_frame", "base_link", 5.0);
  EXPECT_TRUE((back.T_to_from * found.T_to_from).isApprox(Pose::Identity()));
  EXPECT_TRUE(tree.find("x", "x", 0.0).T_to_from.isApprox(Pose::Identity()));
}

// Drivers may hang the body below a sensor.
TEST(TransformTree, TwoBranchesMeetAtTheirCommonAncestor) {
  TransformTree tree;
  tree.add_static("frame", "base_link", at({0.0, 0.0, 0.5}, 1.0));
  tree.add_static("frame", "camera", at({1.0, 0.0, 0.0}));
  const auto found = tree.find("base_link", "camera", 0.0);
  ASSERT_EQ(found.status, Status::kFound);
  EXPECT_TRUE(found.T_to_from.isApprox(at({0.0, 0.0, 0.5}, 1.0).inverse() * at({1.0, 0.0, 0.0})));
}

TEST(TransformTree, AJointIsWhereItWasAtTheTime) {
  TransformTree tree;
  tree.add_static("gimbal", "camera", at({0.1, 0.0, 0.0}));
  for (int i = 0; i <= 10; ++i)
    tree.add_moving("base_link", "gimbal", 10.0 + 0.05 * i, at(Vec3::Zero(), 0.0, 0.1 * i));
  const auto found = tree.find("base_link", "camera", 10.125);
  ASSERT_EQ(found.status, Status::kFound);
  EXPECT_TRUE(found.moves);
  EXPECT_TRUE(found.T_to_from.isApprox(at(Vec3::Zero(), 0.0, 0.25) * at({0.1, 0.0, 0.0}), 1e-9));
  EXPECT_EQ(tree.find("base_link", "camera", 10.0).status, Status::kFound);
  EXPECT_TRUE(
      tree.find("base_link", "gimbal", 10.55).T_to_from.isApprox(at(Vec3::Zero(), 0.0, 1.0), 1e-9));
  const auto late = tree.find("base_link", "camera", 11.0);
  EXPECT_EQ(late.status, Status::kNotThen);
  EXPECT_THAT(late.why, HasSubstr("newest transform of 'gimbal' is 0.50 s older"));
  const auto early = tree.find("base_link", "camera", 9.0);
  EXPECT_EQ(early.status, Status::kNotThen);
  EXPECT_THAT(early.why, HasSubstr("begins 1.00 s later"));
  tree.add_moving("base_link", "gimbal", 1.0, at(Vec3::Zero(), 0.0, 0.7));  // started anew
  EXPECT_EQ(tree.find("base_link", "camera", 1.0).status, Status::kFound);
}

TEST(TransformTree, SaysWhatIsMissing) {
  TransformTree tree;
  EXPECT_THAT(tree.find("base_link", "camera", 0.0).why,
              HasSubstr("no transform of 'camera' is known"));
  tree.add_static("uav2/base_link", "camera", at(Vec3::Zero()));
  const auto found = tree.find("uav1/base_link", "camera", 0.0);
  EXPECT_EQ(found.status, Status::kNoChain);
  EXPECT_THAT(found.why,
              HasSubstr("from 'camera' to 'uav2/base_link', and not to 'uav1/base_link'"));
}

TEST(TransformTree, TheFirstOfTwoThatContradictStays) {
  TransformTree tree;
  EXPECT_EQ(tree.add_static("base_link", "camera", at({0.1, 0.0, 0.0})), Added::kTaken);
  EXPECT_EQ(tree.add_static("base_link", "camera", at({0.1, 0.0, 0.0})), Added::kTaken);
  EXPECT_EQ(tree.add_static("base_link", "camera", at({0.1, 0.0, 0.0}, kPi / 2)),
            Added::kContradicts);
  EXPECT_EQ(tree.add_static("uav2/base_link", "camera", at({0.1, 0.0, 0.0})), Added::kContradicts);
  EXPECT_EQ(tree.add_moving("base_link", "camera", 1.0, at({0.1, 0.0, 0.0})), Added::kContradicts);
  EXPECT_TRUE(tree.find("base_link", "camera", 0.0).T_to_from.isApprox(at({0.1, 0.0, 0.0})));
}

TEST(TransformTree, CirclesEndAndFramesAreBounded) {
  TransformTree tree;
  tree.add_static("a", "b", at(Vec3::Zero()));
  tree.add_static("b", "a", at(Vec3::Zero()));
  EXPECT_EQ(tree.find("base_link", "a", 0.0).status, Status::kNoChain);
  Added last = Added::kTaken;
  for (int i = 0; i < 1000; ++i)
    last = tree.add_static("a", "f" + std::to_string(i), at(Vec3::Zero()));
  EXPECT_EQ(last, Added::kFull);
}

}  // namespace
}  // namespace foretrack
