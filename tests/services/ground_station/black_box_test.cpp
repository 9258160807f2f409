// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/recording/black_box.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <map>
#include <ratio>
#include <set>
#include <string>

#include "services/ground_station/recording/keep_within.hpp"
#include "tests/support/folder.hpp"

namespace foretrack::station {
namespace {

namespace fs = std::filesystem;
using testing::Folder;

Channel of(const std::string& wire, const std::string& type) {
  Channel channel;
  channel.wire = wire;
  channel.type = type;
  return channel;
}

TEST(BlackBox, LeavesOutPicturesUnlessAskedFor) {
  ServiceOptions options;
  const char* kPictures[] = {
      "sensor_msgs::msg::dds_::Image_", "sensor_msgs::msg::dds_::CompressedImage_",
      "foxglove_msgs::msg::dds_::CompressedVideo_", "foretrack_msgs::msg::dds_::TargetChoice_"};
  for (const char* type : kPictures) {
    options.record.images = false;
    EXPECT_TRUE(is_left_out(of("rt/uav1/camera/color/image", type), options)) << type;
    EXPECT_TRUE(is_left_out(of("rt/front/anything", type), options)) << type;
    options.record.images = true;
    EXPECT_FALSE(is_left_out(of("rt/uav1/camera/color/image", type), options)) << type;
  }
}

TEST(BlackBox, KeepsTheOwnVehiclesTopicsAndSharedOnesAlone) {
  const ServiceOptions options;
  const std::string state = "foretrack_msgs::msg::dds_::TargetState_";
  EXPECT_FALSE(is_left_out(of("rt/uav1/target/state", state), options));
  EXPECT_TRUE(is_left_out(of("rt/uav2/target/state", state), options));
  EXPECT_FALSE(is_left_out(of("rt/tf", "tf2_msgs::msg::dds_::TFMessage_"), options));
  EXPECT_FALSE(is_left_out(of("rt/rosout", "rcl_interfaces::msg::dds_::Log_"), options));
}

TEST(BlackBox, HasAFolderForEachVehicleBesideTheStatesUnlessItIsTold) {
  ServiceOptions options;
  options.state_folder = "/s";
  EXPECT_EQ(black_box_folder(options), "/s/recordings/uav1");
  options.record.folder = "/r";
  EXPECT_EQ(black_box_folder(options), "/r");
}

// Files of 1000 bytes that were written so many days ago, oldest first.
void fill(const fs::path& folder, const std::map<std::string, double>& days_ago) {
  for (const auto& [name, days] : days_ago) {
    std::ofstream(folder / name) << std::string(1000, 'x');
    const auto ago = std::chrono::duration<double, std::ratio<86400>>(days);
    fs::last_write_time(folder / name,
                        fs::file_time_type::clock::now() -
                            std::chrono::duration_cast<fs::file_time_type::duration>(ago));
  }
}

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

TEST(KeepWithin, RemovesRecordingsThatAreTooOld) {
  const Folder folder;
  fill(folder.path, {{"a.mcap", 9.0}, {"b.mcap", 2.0}, {"notes.txt", 90.0}});
  EXPECT_EQ(keep_within(folder.path, {1'000'000, 7.0}), 1);
  EXPECT_EQ(names_in(folder.path), (std::set<std::string>{"b.mcap", "notes.txt"}));
}

TEST(KeepWithin, RemovesTheOldestUntilTheRestFits) {
  const Folder folder;
  fill(folder.path, {{"a.mcap", 3.0}, {"b.mcap", 2.0}, {"c.mcap", 1.0}});
  EXPECT_EQ(keep_within(folder.path, {2500, 7.0}), 1);
  EXPECT_EQ(names_in(folder.path), (std::set<std::string>{"b.mcap", "c.mcap"}));
  EXPECT_EQ(keep_within(folder.path, {2500, 7.0}), 0);
}

TEST(KeepWithin, NeverRemovesTheFileThatIsWritten) {
  const Folder folder;
  fill(folder.path, {{"a.mcap", 3.0}, {"b.mcap", 2.0}});
  EXPECT_EQ(keep_within(folder.path, {10, 1.0}, "a.mcap"), 1);
  EXPECT_EQ(names_in(folder.path), (std::set<std::string>{"a.mcap"}));
}

TEST(KeepWithin, LivesWithoutAFolder) {
  EXPECT_EQ(keep_within("/no/such/folder", {10, 1.0}), 0);
}

}  // namespace
}  // namespace foretrack::station
