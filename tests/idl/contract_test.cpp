// SPDX-License-Identifier: Apache-2.0
// The IDL files stay within what every tool in use can read, and the README names every topic.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "px4_msgs/msg/BatteryStatus.h"
#include "px4_msgs/msg/FailsafeFlags.h"
#include "px4_msgs/msg/OffboardControlMode.h"
#include "px4_msgs/msg/TrajectorySetpoint.h"
#include "px4_msgs/msg/VehicleCommand.h"
#include "px4_msgs/msg/VehicleOdometry.h"
#include "px4_msgs/msg/VehicleStatus.h"
#include "services/common/topics.hpp"

namespace foretrack {
namespace {

namespace fs = std::filesystem;

const fs::path kIdl = fs::path(FORETRACK_SOURCE_DIR) / "idl";

std::string text_of_file(const fs::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<fs::path> idl_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(kIdl))
    if (entry.path().extension() == ".idl") files.push_back(entry.path());
  return files;
}

std::string without_comments(const std::string& text) {
  return std::regex_replace(text, std::regex("//[^\n]*"), "");
}

bool contains(const std::string& text, const std::string& pattern) {
  return std::regex_search(text, std::regex(pattern));
}

TEST(Idl, AvoidsWhatSomeToolCannotRead) {
  ASSERT_GT(idl_files().size(), 40u);
  for (const auto& path : idl_files()) {
    const std::string text = without_comments(text_of_file(path));
    EXPECT_FALSE(contains(text, "@|bitmask|bitset|\\bunion\\b|\\bcontext\\b")) << path;
    EXPECT_FALSE(contains(text, "struct \\w+ \\{\\s*\\}")) << path << ": an empty struct";
    EXPECT_FALSE(contains(text, "struct \\w+ *:")) << path << ": inheritance";
    EXPECT_FALSE(contains(text, "sequence<\\s*sequence")) << path;
    EXPECT_FALSE(contains(text, "\\[[A-Za-z_]")) << path << ": an array sized by a constant";
  }
}

TEST(Idl, NamesNoMemberLikeItsTypeButForCase) {
  const std::regex member("(\\w+) (\\w+);");
  for (const auto& path : idl_files()) {
    const std::string text = without_comments(text_of_file(path));
    for (std::sregex_iterator it(text.begin(), text.end(), member), end; it != end; ++it) {
      std::string type = (*it)[1], name = (*it)[2];
      if (type == name) continue;
      std::transform(type.begin(), type.end(), type.begin(), ::tolower);
      // A struct of another module may share the word: case-sensitive tools (-cs) tell them apart.
      if (contains(text, "::" + std::string((*it)[1]) + " " + name)) continue;
      EXPECT_NE(type, name) << path;
    }
  }
}

TEST(Idl, BoundsEveryStringAndSequenceOfOurs) {
  for (const auto& path : idl_files()) {
    if (path.string().find("foretrack_msgs") == std::string::npos) continue;
    const std::string text = without_comments(text_of_file(path));
    EXPECT_FALSE(contains(text, "\\bstring [a-z]")) << path;
    EXPECT_FALSE(contains(text, "sequence<[^,>]*>")) << path;
  }
}

TEST(Idl, HoldsTheTypeThatItsFileIsNamedAfter) {
  for (const auto& path : idl_files()) {
    const std::string text = text_of_file(path);
    EXPECT_TRUE(contains(text, "struct " + path.stem().string() + " \\{")) << path;
    const std::string package = path.parent_path().parent_path().filename();
    EXPECT_TRUE(contains(text, "module " + package + " \\{")) << path;
  }
}

// Sizes by hand from PX4's definitions, with CDR's alignment.
TEST(Idl, HasPx4sMessagesByteForByte) {
  using namespace px4_msgs::msg;
  EXPECT_EQ(TrajectorySetpoint::getCdrSerializedSize({}), 8u + 4 * 12 + 2 * 4);
  EXPECT_EQ(OffboardControlMode::getCdrSerializedSize({}), 8u + 7);
  EXPECT_EQ(FailsafeFlags::getCdrSerializedSize({}), 8u + 13 * 4 + 26);
  EXPECT_EQ(VehicleCommand::getCdrSerializedSize({}), 56u);
  EXPECT_EQ(VehicleOdometry::getCdrSerializedSize({}), 16u + 4 + 12 + 16 + 4 + 5 * 12 + 2);
}

// "pkg::msg::dds_::Name_" as people write it.
std::string readable(std::string name) {
  name = std::regex_replace(name, std::regex("::msg::dds_::"), "/");
  name.pop_back();
  return name;
}

std::string scope_mark(Scope scope) {
  switch (scope) {
    case Scope::kShared:
      return " (shared)";
    case Scope::kClock:
      return " (clock)";
    case Scope::kPx4:
      return " (px4)";
    default:
      return "";
  }
}

template <class... Topics>
std::vector<std::string> rows_of(const std::tuple<Topics...>*) {
  return {("\\| `" + std::string(Topics::info.name) + "`" +
           std::regex_replace(scope_mark(Topics::info.scope), std::regex("[()]"), "\\$&") +
           " \\| " + readable(TypeName<typename Topics::Type>::value) +
           " \\| [^|]+ \\| [^|]+ \\| " + Topics::info.profile + " \\| [^|]+ \\|\n")...};
}

TEST(TopicTable, NamesEveryTopicWithTypeAndProfileAndNoOther) {
  const std::string readme = text_of_file(kIdl / "README.md");
  const auto rows = rows_of(static_cast<const topics::All*>(nullptr));
  for (const auto& row : rows) EXPECT_TRUE(contains(readme, row)) << row;
  const std::regex any_row("\n\\| `");
  const auto written = std::distance(std::sregex_iterator(readme.begin(), readme.end(), any_row),
                                     std::sregex_iterator());
  EXPECT_EQ(static_cast<std::size_t>(written), rows.size());
}

template <class... Topics>
std::set<std::string> wire_names(const std::tuple<Topics...>*, const Names& names) {
  return {topic_name(Topics::info, names)...};
}

TEST(Topics, HaveDistinctNamesOnTheWire) {
  const auto names = wire_names(static_cast<const topics::All*>(nullptr), {});
  EXPECT_EQ(names.size(), std::tuple_size_v<topics::All>);
  EXPECT_TRUE(names.contains("rt/uav1/target/state"));
  EXPECT_TRUE(names.contains("rt/fmu/in/trajectory_setpoint"));
  EXPECT_TRUE(names.contains("rt/fmu/out/vehicle_status_v1"));
}

TEST(Topics, FollowTheNamesOfPx4sReleasesAndVehicles) {
  Names names;
  names.px4_namespace = "px4_2";
  names.px4_release = "1.15";
  EXPECT_EQ(topic_name(topics::Px4VehicleStatus::info, names), "rt/px4_2/fmu/out/vehicle_status");
  EXPECT_EQ(topic_name(topics::Px4VehicleOdometry::info, names),
            "rt/px4_2/fmu/out/vehicle_odometry");
  names.px4_release = "1.18";
  EXPECT_EQ(topic_name(topics::Px4VehicleStatus::info, names),
            "rt/px4_2/fmu/out/vehicle_status_v4");
  EXPECT_EQ(topic_name(topics::Px4BatteryStatus::info, names),
            "rt/px4_2/fmu/out/battery_status_v1");
}

TEST(Topics, HaveProfilesThatTheFileDefinesForBothSides) {
  const std::string xml = text_of_file(fs::path(FORETRACK_SOURCE_DIR) / "qos" / "profiles.xml");
  for (const std::string name : {"sensor", "image", "state", "latched", "log", "command", "map"}) {
    EXPECT_TRUE(contains(xml, "data_writer profile_name=\"" + name + "\"")) << name;
    EXPECT_TRUE(contains(xml, "data_reader profile_name=\"" + name + "\"")) << name;
  }
}

}  // namespace
}  // namespace foretrack
