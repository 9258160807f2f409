// SPDX-License-Identifier: Apache-2.0
#include "services/common/px4_releases.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <regex>
#include <sstream>

#include "px4_msgs/msg/ArmingCheckReply.h"
#include "px4_msgs/msg/BatteryStatus.h"
#include "px4_msgs/msg/FailsafeFlags.h"
#include "px4_msgs/msg/RegisterExtComponentReply.h"
#include "px4_msgs/msg/VehicleStatus.h"
#include "services/common/raw.hpp"

namespace foretrack {
namespace {

constexpr const char* kMessages[] = {"VehicleStatus",
                                     "BatteryStatus",
                                     "VehicleLocalPosition",
                                     "FailsafeFlags",
                                     "VehicleOdometry",
                                     "VehicleCommand",
                                     "VehicleControlMode",
                                     "VehicleCommandAck",
                                     "OffboardControlMode",
                                     "TimesyncStatus",
                                     "ManualControlSetpoint",
                                     "TrajectorySetpoint",
                                     "HomePosition",
                                     "RegisterExtComponentRequest",
                                     "RegisterExtComponentReply",
                                     "UnregisterExtComponent",
                                     "ArmingCheckRequest",
                                     "ArmingCheckReply",
                                     "Event",
                                     "ModeCompleted"};

std::string wire_type(const std::string& message) {
  return "px4_msgs::msg::dds_::" + message + "_";
}

const Px4Layout::Field& field(const Px4Layout& layout, std::string_view name) {
  for (const auto& f : layout.fields)
    if (f.name == name) return f;
  throw std::out_of_range(std::string(name));
}

TEST(Px4Releases, EveryMessageIsKnownInEveryRelease) {
  for (const auto release : kPx4Releases)
    for (const char* message : kMessages)
      EXPECT_FALSE(px4_layout_of(wire_type(message), release).fields.empty())
          << message << " " << release;
  EXPECT_TRUE(px4_layout_of("nav_msgs::msg::dds_::Odometry_", "1.16").fields.empty());
  EXPECT_THROW(check_px4_release("1.14"), std::invalid_argument);
}

// The IDL's own fields are those of 1.16, in order.
TEST(Px4Releases, TheIdlIsThatOfItsRelease) {
  for (const char* message : kMessages) {
    std::ifstream file(std::string(FORETRACK_SOURCE_DIR) + "/idl/px4_msgs/msg/" + message + ".idl");
    std::ostringstream text;
    text << file.rdbuf();
    const std::string idl = text.str();
    const std::string body = idl.substr(idl.find("struct " + std::string(message)));
    const std::regex member("\\n  ([\\w:]+) (\\w+)(\\[\\d+\\])?;");
    std::vector<std::string> names;
    for (std::sregex_iterator it(body.begin(), body.end(), member), end; it != end; ++it)
      names.push_back((*it)[2]);
    const auto layout = px4_layout_of(wire_type(message), kPx4ReleaseOfIdl);
    ASSERT_EQ(names.size(), layout.fields.size()) << message;
    for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(names[i], layout.fields[i].name);
  }
  using namespace px4_msgs::msg;
  const auto bytes = [](const char* m) { return px4_layout_of(wire_type(m), "1.16").bytes; };
  EXPECT_EQ(bytes("FailsafeFlags"), FailsafeFlags::getCdrSerializedSize({}));
  EXPECT_EQ(bytes("VehicleStatus"), VehicleStatus::getCdrSerializedSize({}));
  EXPECT_EQ(bytes("BatteryStatus"), BatteryStatus::getCdrSerializedSize({}));
  EXPECT_EQ(bytes("Event"), 40u);
  EXPECT_EQ(bytes("ArmingCheckReply"), ArmingCheckReply::getCdrSerializedSize({}));
  EXPECT_EQ(bytes("RegisterExtComponentReply"),
            RegisterExtComponentReply::getCdrSerializedSize({}));
}

TEST(Px4Releases, VersionsAreThoseOfTheReleases) {
  EXPECT_EQ(px4_version("vehicle_status", "1.15"), 0);
  EXPECT_EQ(px4_version("vehicle_status", "1.16"), 1);
  EXPECT_EQ(px4_version("vehicle_status", "1.17"), 1);
  EXPECT_EQ(px4_version("vehicle_status", "1.18"), 4);
  EXPECT_EQ(px4_version("battery_status", "1.16"), 0);
  EXPECT_EQ(px4_version("battery_status", "1.17"), 1);
  EXPECT_EQ(px4_version("vehicle_local_position", "1.17"), 1);
  EXPECT_EQ(px4_version("vehicle_command_ack", "1.18"), 1);
  EXPECT_EQ(px4_version("trajectory_setpoint", "1.18"), 0);
  EXPECT_EQ(px4_version("register_ext_component_request", "1.17"), 0);
  EXPECT_EQ(px4_version("register_ext_component_request", "1.18"), 2);
  EXPECT_EQ(px4_version("register_ext_component_reply", "1.18"), 1);
  EXPECT_EQ(px4_version("arming_check_reply", "1.16"), 0);
  EXPECT_EQ(px4_version("arming_check_request", "1.17"), 1);
}

TEST(Px4Releases, ARearrangedMessageHasItsValuesWhereTheReleaseHasThem) {
  px4_msgs::msg::BatteryStatus battery;
  battery.remaining(0.375F);
  battery.warning(2);
  battery.faults(0x1234);
  CdrBytes bytes = to_cdr(type_ops<px4_msgs::msg::BatteryStatus>(), &battery);
  const auto ours = px4_layout_of(wire_type("BatteryStatus"), "1.16");
  for (const auto release : kPx4Releases) {
    const auto theirs = px4_layout_of(wire_type("BatteryStatus"), release);
    std::vector<std::uint8_t> out, back;
    rearrange(ours, {bytes.data() + 4, ours.bytes}, theirs, out);
    ASSERT_EQ(out.size(), theirs.bytes);
    EXPECT_EQ(out[field(theirs, "warning").at], 2) << release;
    float remaining = 0.0F;
    std::memcpy(&remaining, &out[field(theirs, "remaining").at], sizeof remaining);
    EXPECT_EQ(remaining, 0.375F) << release;
    rearrange(theirs, out, ours, back);
    EXPECT_EQ(back[field(ours, "warning").at], 2);
    EXPECT_EQ(back[field(ours, "faults").at + 1], 0x12);
  }
  // What went wrong between them: from 1.17 on the warning comes first.
  const auto newer = px4_layout_of(wire_type("BatteryStatus"), "1.17");
  EXPECT_LT(field(newer, "warning").at, field(newer, "faults").at);
  EXPECT_GT(field(ours, "warning").at, field(ours, "faults").at);
}

TEST(Px4Releases, TheTopicsTellTheRelease) {
  const auto release = [](std::vector<std::string> names, const char* px4_namespace = "") {
    return px4_release_of(names, px4_namespace);
  };
  EXPECT_EQ(release({"rt/fmu/out/vehicle_status", "rt/fmu/out/battery_status"}), "1.15");
  EXPECT_EQ(release({"rt/fmu/out/vehicle_status_v1", "rt/fmu/out/battery_status"}), "1.16");
  EXPECT_EQ(release({"rt/fmu/out/vehicle_status_v1", "rt/fmu/out/vehicle_local_position_v1"}),
            "1.17");
  EXPECT_EQ(release({"rt/px4_2/fmu/out/vehicle_status_v4", "rt/px4_2/fmu/out/battery_status_v1"},
                    "px4_2"),
            "1.18");
  EXPECT_EQ(release({"rt/fmu/out/vehicle_odometry"}), "");
}

}  // namespace
}  // namespace foretrack
