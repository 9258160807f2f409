// SPDX-License-Identifier: Apache-2.0
#include "services/convert/transforms.hpp"

#include <gmock/gmock.h>

#include "core/common/camera.hpp"
#include "services/convert/geometry.hpp"

namespace foretrack {
namespace {

using testing::HasSubstr;

tf2_msgs::msg::TFMessage mount(const std::string& body = "base_link") {
  tf2_msgs::msg::TFMessage message;
  to_transform(CameraModel::default_mount(), body, "camera", 0.0, message);
  return message;
}

TEST(TransformMessage, MapToBodyIsTheVehiclesPose) {
  VehicleState state;
  state.position_enu_m = {1, 2, 3};
  tf2_msgs::msg::TFMessage message;
  to_transform(state, "uav1/base_link", message);
  ASSERT_EQ(message.transforms().size(), 1u);
  EXPECT_EQ(message.transforms()[0].header().frame_id(), kWorldFrame);
  EXPECT_EQ(message.transforms()[0].child_frame_id(), "uav1/base_link");
  EXPECT_EQ(message.transforms()[0].transform().translation().y(), 2.0);
}

TEST(TakeTransforms, PutsThemIntoTheTree) {
  TransformTree tree;
  auto message = mount("/base_link");  // as ROS 1 had them
  EXPECT_FALSE(take_transforms(message, true, tree));
  EXPECT_TRUE(
      tree.find("base_link", "camera", 0.0).T_to_from.isApprox(CameraModel::default_mount(), 1e-9));
}

TEST(TakeTransforms, NamesWhatItDoesNotTake) {
  TransformTree tree;
  take_transforms(mount(), true, tree);
  const auto fault = take_transforms(mount("uav2/base_link"), true, tree);
  ASSERT_TRUE(fault);
  EXPECT_THAT(fault->text, HasSubstr("'camera' (from 'uav2/base_link') contradicts"));
  auto broken = mount();
  broken.transforms()[0].transform().rotation().w(7.0);
  EXPECT_EQ(take_transforms(broken, true, tree)->field, "transforms.rotation");
  broken = mount("");
  EXPECT_EQ(take_transforms(broken, true, tree)->field, "transforms.frame_id");
}

}  // namespace
}  // namespace foretrack
