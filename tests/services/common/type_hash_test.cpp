// SPDX-License-Identifier: Apache-2.0
#include "services/common/type_hash.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

// As `ros2 topic info -v` of Jazzy prints them, in public reports.
TEST(TypeHash, IsWhatRos2SaysOfItsOwnTypes) {
  const std::pair<const char*, const char*> published[] = {
      {"std_msgs::msg::dds_::String_",
       "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"},
      {"geometry_msgs::msg::dds_::Twist_",
       "RIHS01_9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a"},
      {"sensor_msgs::msg::dds_::Image_",
       "RIHS01_d31d41a9a4c4bc8eae9be757b0beed306564f7526c88ea6a4588fb9582527d47"},
      {"rosgraph_msgs::msg::dds_::Clock_",
       "RIHS01_692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564"}};
  for (const auto& [type, hash] : published) EXPECT_EQ(type_hash_of(type), hash) << type;
}

TEST(TypeHash, IsThereForOurTypesAndForTypesInsideThem) {
  for (const char* type :
       {"foretrack_msgs::msg::dds_::TargetState_", "foretrack_msgs::msg::dds_::TrajectoryPiece_",
        "rcl_interfaces::srv::dds_::ListParameters_Request_"})
    EXPECT_EQ(type_hash_of(type).size(), 71u) << type;
  EXPECT_EQ(type_hash_of("other_msgs::msg::dds_::Thing_"), "");
}

TEST(TypeHash, IsReadBackFromWhatAnEndpointTells) {
  const auto told = read_told(told_of_type("foretrack_msgs::msg::dds_::TargetState_"));
  EXPECT_EQ(told.hash, type_hash_of("foretrack_msgs::msg::dds_::TargetState_"));
  EXPECT_FALSE(told.version.empty());
  EXPECT_EQ(other_version("foretrack_msgs::msg::dds_::TargetState_", told), "");
  EXPECT_TRUE(told_of_type("other_msgs::msg::dds_::Thing_").empty());
}

TEST(TypeHash, NamesAnotherVersionAndBelievesWhoTellsNothing) {
  const std::string type = "foretrack_msgs::msg::dds_::TargetState_";
  const auto text = other_version(type, {"RIHS01_00", "9.8.7"});
  EXPECT_NE(text.find("TargetState_ is of another version"), std::string::npos) << text;
  EXPECT_NE(text.find("foretrack 9.8.7"), std::string::npos) << text;
  EXPECT_EQ(other_version(type, {"", ""}), "");
  EXPECT_EQ(other_version("other_msgs::msg::dds_::Thing_", {"RIHS01_00", ""}), "");
}

TEST(TypeHash, ReadsWhatOthersTellBesides) {
  const std::string text = "clientid=1.2.3;typehash=RIHS01_ab;x";
  EXPECT_EQ(read_told({text.begin(), text.end()}).hash, "RIHS01_ab");
  EXPECT_EQ(read_told({}).hash, "");
}

}  // namespace
}  // namespace foretrack
