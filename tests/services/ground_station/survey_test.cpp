// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/bus/survey.hpp"

#include <gtest/gtest.h>

#include "services/ground_station/bus/contract.hpp"
#include "services/ground_station/schemas/schema_table.hpp"

namespace foretrack::station {
namespace {

constexpr char kOdometry[] = "nav_msgs::msg::dds_::Odometry_";

ForeignEndpoint writer(std::string topic, std::string type, bool reliable = true,
                       bool latched = false) {
  return {std::move(topic), std::move(type), false, true, "", reliable, latched, {}, ""};
}
ForeignEndpoint reader(std::string topic, std::string type, bool reliable = true,
                       bool latched = false) {
  return {std::move(topic), std::move(type), false, false, "", reliable, latched, {}, ""};
}

TEST(Survey, CountsWritersAndReadersOfEachTopicOfRos) {
  const auto topics =
      survey({writer("rt/uav1/odometry", kOdometry), reader("rt/uav1/odometry", kOdometry),
              reader("rt/uav1/odometry", kOdometry), writer("ros_discovery_info", "x"),
              writer("rt/other", "T")});
  ASSERT_EQ(topics.size(), 2u);
  EXPECT_EQ(topics.at("rt/uav1/odometry").writers, 1);
  EXPECT_EQ(topics.at("rt/uav1/odometry").readers, 2);
  EXPECT_EQ(topics.at("rt/other").type, "T");
}

TEST(Survey, AsksForNoMoreThanEveryWriterOffers) {
  EXPECT_STREQ(survey({writer("rt/a", "T")}).at("rt/a").profile, "state");
  EXPECT_STREQ(survey({writer("rt/a", "T", false)}).at("rt/a").profile, "sensor");
  EXPECT_STREQ(survey({writer("rt/a", "T", true, true)}).at("rt/a").profile, "latched");
  EXPECT_STREQ(survey({writer("rt/a", "T", true, true), writer("rt/a", "T")}).at("rt/a").profile,
               "state");
  EXPECT_STREQ(survey({writer("rt/a", "T"), writer("rt/a", "T", false)}).at("rt/a").profile,
               "sensor");
  EXPECT_STREQ(survey({reader("rt/a", "T")}).at("rt/a").profile, "state");
}

TEST(Survey, ShowsForeignTypesAndQualitiesOfServiceThatDoNotFit) {
  const auto foreign =
      survey({writer("rt/uav1/odometry", "other::T"), reader("rt/uav1/odometry", kOdometry)});
  EXPECT_EQ(foreign.at("rt/uav1/odometry").type, kOdometry);
  EXPECT_EQ(foreign.at("rt/uav1/odometry").foreign_type, "other::T");
  EXPECT_EQ(foreign.at("rt/uav1/odometry").writers, 0);
  EXPECT_TRUE(survey({writer("rt/a", "T", false), reader("rt/a", "T")}).at("rt/a").qos_mismatch);
  EXPECT_TRUE(
      survey({writer("rt/a", "T"), reader("rt/a", "T", true, true)}).at("rt/a").qos_mismatch);
  EXPECT_FALSE(survey({writer("rt/a", "T"), reader("rt/a", "T", false)}).at("rt/a").qos_mismatch);
}

TEST(Contract, KnowsTheVehicleOfATopic) {
  EXPECT_EQ(vehicle_of("rt/uav1/target/state"), "uav1");
  EXPECT_EQ(vehicle_of("rt/px4_1/odometry"), "px4_1");
  for (const auto* topic :
       {"rt/tf", "rt/fmu/out/vehicle_odometry", "rt/uav1/private", "uav1/x", ""})
    EXPECT_EQ(vehicle_of(topic), "") << topic;
  EXPECT_EQ(contract_of("rt/tf")->type, "tf2_msgs::msg::dds_::TFMessage_");
  EXPECT_EQ(contract_of("rt/uav7/odometry")->type, kOdometry);
}

TEST(Schemas, HasOneForEveryTypeOfTheContractAndFindsIt) {
  for (const auto& topic : contract()) {
    const auto* schema = find_schema(topic.type);
    ASSERT_TRUE(schema) << topic.type;
    const bool own = topic.type.starts_with("foretrack_msgs");
    EXPECT_EQ(schema->encoding, own ? "omgidl" : "ros2msg") << topic.type;
    EXPECT_EQ(schema->text.find("#include"), std::string_view::npos);
  }
  for (const auto& row : schema_table()) EXPECT_EQ(find_schema(row.wire_type), &row.schema);
  EXPECT_EQ(find_schema("unknown"), nullptr);
  EXPECT_EQ(find_ros_schema("unknown"), nullptr);
  EXPECT_EQ(readable_type(kOdometry), "nav_msgs/msg/Odometry");
  EXPECT_EQ(readable_type("a::msg::dds_::B_"), "a::msg::B");
  EXPECT_EQ(readable_type("whatever"), "whatever");
}

TEST(Schemas, HaveRos2sFormForEveryType) {
  for (const auto& topic : contract()) {
    const auto* schema = find_ros_schema(topic.type);
    ASSERT_TRUE(schema) << topic.type;
    EXPECT_EQ(schema->encoding, "ros2msg") << topic.type;
    EXPECT_NE(schema->name.find("/msg/"), std::string_view::npos) << schema->name;
  }
  EXPECT_EQ(find_ros_schema("foretrack_msgs::msg::dds_::TargetState_")->name,
            "foretrack_msgs/msg/TargetState");
}

TEST(Schemas, TellARecordedTypeThatGrewFromOneThatChanged) {
  const std::string type = "foretrack_msgs::msg::dds_::TargetState_";
  for (const Schema* ours : {find_schema(type), find_ros_schema(type)}) {
    const std::string text(ours->text);
    const auto last = text.find("uint32 rejected_measurements");
    const auto end = text.find_first_of('\n', last) + 1;
    ASSERT_NE(last, std::string::npos);
    auto before = text, changed = text;
    before.erase(text.rfind('\n', last) + 1, end - text.rfind('\n', last) - 1);
    changed.replace(last, 6, "uint16");
    EXPECT_EQ(compare_recorded(type, "", text), RecordedType::kSame);
    EXPECT_EQ(compare_recorded(type, "", before), RecordedType::kOlder) << before;
    EXPECT_EQ(compare_recorded(type, "RIHS01_00", before), RecordedType::kOlder);
    EXPECT_EQ(compare_recorded(type, "", changed), RecordedType::kOther);
  }
  EXPECT_EQ(compare_recorded("other::msg::dds_::T_", "", "int32 x"), RecordedType::kUnknown);
}

}  // namespace
}  // namespace foretrack::station
