// SPDX-License-Identifier: Apache-2.0
#include "services/common/names.hpp"

#include <gmock/gmock.h>

#include "services/common/presets.hpp"
#include "services/common/topics.hpp"
#include "tests/support/error_of.hpp"

namespace foretrack {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::string refusal(const std::string& remap) {
  Names names;
  return error_of([&] {
    add_remap(names, remap);
    return 0;
  });
}

TEST(Remap, ATopicOfOthersTakesTheNamesPlace) {
  Names names;
  add_remap(names, "odometry:=mavros/local_position/odom");
  add_remap(names, "camera/color/image:=/Cam0/image_raw");
  EXPECT_EQ(topic_name(topics::Odometry::info, names), "rt/mavros/local_position/odom");
  EXPECT_EQ(topic_name(topics::ColorImage::info, names), "rt/Cam0/image_raw");
  EXPECT_EQ(topic_name(topics::DepthImage::info, names), "rt/uav1/camera/depth/image");
}

TEST(Remap, SaysWhatIsWrong) {
  EXPECT_THAT(refusal("odometry"), HasSubstr("NAME:=TOPIC expected"));
  EXPECT_THAT(refusal("camera/colour/image:=x"),
              AllOf(HasSubstr("no topic has this name"), HasSubstr("'camera/color/image'")));
  EXPECT_THAT(refusal("odometry:=a b"), HasSubstr("a topic expected"));
  EXPECT_THAT(refusal("odometry:="), HasSubstr("a topic expected"));
  EXPECT_THAT(refusal("odometry:=a//b"), HasSubstr("a topic expected"));
}

TEST(Preset, RemapsWhatADriverPublishesAndIsFoundByIt) {
  Names names;
  add_preset(names, "realsense");
  EXPECT_EQ(topic_name(topics::ColorCameraInfo::info, names), "rt/camera/camera/color/camera_info");
  add_remap(names, "camera/depth/image:=mine");
  EXPECT_EQ(topic_name(topics::DepthImage::info, names), "rt/mine");
  EXPECT_THAT(error_of([&] {
                add_preset(names, "kinect");
                return 0;
              }),
              HasSubstr("realsense"));
  const std::vector<std::string> bus = {"rt/image_raw", "rt/camera_info", "rt/tf",
                                        "rt/mavros/local_position/odom"};
  EXPECT_THAT(presets_that_fit(bus), ElementsAre("usb_cam", "mavros"));
}

// Presets name topics that exist.
TEST(Preset, EveryOneIsWhole) {
  for (const Preset& preset : presets())
    for (const auto& remap : preset.remaps) {
      Names names;
      EXPECT_NO_THROW(add_remap(names, std::string(remap.name) + ":=" + std::string(remap.topic)));
    }
}

TEST(Names, FramesCarryTheVehiclesName) {
  Names names;
  names.vehicle = "kestrel";
  EXPECT_EQ(names.frame("base_link"), "kestrel/base_link");
  names.px4_release = "2.0";
  EXPECT_THROW(validate_or_throw(names), std::invalid_argument);
}

}  // namespace
}  // namespace foretrack
