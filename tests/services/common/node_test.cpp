// SPDX-License-Identifier: Apache-2.0
#include "services/common/node.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "diagnostic_msgs/msg/DiagnosticArray.h"
#include "foretrack_msgs/msg/TargetState.h"
#include "nav_msgs/msg/Odometry.h"
#include "rmw_dds_common/msg/ParticipantEntitiesInfo.h"
#include "rmw_dds_common/msg/ParticipantEntitiesInfo24.h"
#include "services/common/cdr_type.hpp"
#include "services/common/reader.hpp"
#include "services/common/topics.hpp"
#include "services/common/writer.hpp"
#include "tests/services/common/bus.hpp"

namespace foretrack::testing {
namespace {

constexpr char kTopic[] = "rt/uav1/target/state";
constexpr char kType[] = "foretrack_msgs::msg::dds_::TargetState_";

TEST(Node, ReportsAPeerWithAnotherTypeName) {
  Node node(node_options("receiver"));
  Reader<topics::TargetState> reader(node);
  RawPeer peer(kTopic, "foretrack_msgs::msg::TargetState");
  peer.add_writer();
  ASSERT_TRUE(eventually([&] { return node.foreign_endpoints().size() == 1; }));
  const auto foreign = node.foreign_endpoints().front();
  EXPECT_EQ(foreign.topic, kTopic);
  EXPECT_TRUE(foreign.writes);
  EXPECT_NE(foreign.why.find("foretrack_msgs::msg::TargetState"), std::string::npos);
  EXPECT_EQ(reader.writers(), 0);
  EXPECT_NE(node.last_error().find("never match"), std::string::npos);
}

TEST(Node, ReportsAPeerWithAKey) {
  RawPeer peer(kTopic, kType, true);
  peer.add_reader();
  Node node(node_options("sender"));
  Writer<topics::TargetState> writer(node);
  ASSERT_TRUE(eventually([&] { return node.foreign_endpoints().size() == 1; }));
  EXPECT_TRUE(node.foreign_endpoints().front().keyed);
  EXPECT_FALSE(node.foreign_endpoints().front().writes);
}

TEST(Node, JudgesPeersThatWereThereBeforeItsOwnEndpoints) {
  Node node(node_options("receiver"));
  Reader<topics::Diagnostics> any(node);
  RawPeer peer(kTopic, "other::Type_");
  peer.add_writer();
  Node witness(node_options("witness"));
  Reader<topics::TargetState> sees(witness);
  ASSERT_TRUE(eventually([&] { return witness.foreign_endpoints().size() == 1; }));
  EXPECT_TRUE(node.foreign_endpoints().empty());
  Reader<topics::TargetState> reader(node);
  EXPECT_TRUE(eventually([&] { return node.foreign_endpoints().size() == 1; }));
}

TEST(Node, ForgetsAForeignPeerThatLeft) {
  Node node(node_options("receiver"));
  Reader<topics::TargetState> reader(node);
  {
    RawPeer peer(kTopic, "other::Type_");
    peer.add_writer();
    ASSERT_TRUE(eventually([&] { return node.foreign_endpoints().size() == 1; }));
  }
  EXPECT_TRUE(eventually([&] { return node.foreign_endpoints().empty(); }));
}

TEST(Node, ReportsAQosMismatchOnBothSides) {
  Node receiver(node_options("receiver"));
  Reader<topics::TargetState> reader(receiver);
  RawPeer peer(kTopic, kType);
  peer.add_writer(dds::BEST_EFFORT_RELIABILITY_QOS);
  ASSERT_TRUE(eventually([&] { return reader.stats().incompatible_qos == 1; }));
  EXPECT_NE(receiver.last_error().find("RELIABILITY"), std::string::npos);

  Node sender(node_options("sender"));
  Writer<topics::TargetState> writer(sender);
  dds::DataReaderQos demanding;
  demanding.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  demanding.durability().kind = dds::TRANSIENT_LOCAL_DURABILITY_QOS;
  peer.add_reader(demanding);
  ASSERT_TRUE(eventually([&] { return writer.stats().incompatible_qos == 1; }));
  EXPECT_NE(sender.last_error().find("DURABILITY"), std::string::npos);
}

// What a ROS 2 node list would read of the node, as Info.
template <class Info>
Info announced_by(Node& node) {
  node.announce();
  RawPeer peer("ros_discovery_info", "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_");
  dds::DataReaderQos qos;
  qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = dds::TRANSIENT_LOCAL_DURABILITY_QOS;
  qos.endpoint().history_memory_policy =
      eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  auto* ros = peer.add_reader(qos);
  RawType::Bytes bytes;
  dds::SampleInfo info;
  EXPECT_TRUE(eventually([&] {
    return ros->take_next_sample(&bytes, &info) ==
               eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK &&
           info.valid_data;
  }));
  eprosima::fastrtps::rtps::SerializedPayload_t payload(static_cast<std::uint32_t>(bytes.size()));
  std::copy(bytes.begin(), bytes.end(), payload.data);
  payload.length = static_cast<std::uint32_t>(bytes.size());
  Info message;
  EXPECT_TRUE(CdrType(type_ops<Info>()).deserialize(&payload, &message));
  return message;
}

template <class Info>
void expect_node_with_endpoints(const std::string& ros_distro) {
  auto options = node_options("perception");
  options.ros_distro = ros_distro;
  Node node(options);
  Writer<topics::TargetState> writer(node);
  Reader<topics::Odometry> reader(node);
  const auto message = announced_by<Info>(node);
  ASSERT_EQ(message.node_entities_info_seq().size(), 1u);
  const auto& entities = message.node_entities_info_seq()[0];
  EXPECT_STREQ(entities.node_namespace().c_str(), "/uav1");
  EXPECT_STREQ(entities.node_name().c_str(), "perception");
  EXPECT_EQ(entities.reader_gid_seq().size(), 1u);
  ASSERT_EQ(entities.writer_gid_seq().size(), 1u);
  const auto& of_writer = entities.writer_gid_seq()[0].data();
  EXPECT_TRUE(std::equal(of_writer.begin(), of_writer.begin() + 12, message.gid().data().begin()))
      << "the same participant";
  EXPECT_NE(of_writer, message.gid().data());
}

TEST(Node, ShowsItselfToRos2HumbleWithItsEndpoints) {
  expect_node_with_endpoints<rmw_dds_common::msg::ParticipantEntitiesInfo24>("humble");
}

TEST(Node, ShowsItselfToRos2IronAndLaterWithItsEndpointsUnlessTold) {
  expect_node_with_endpoints<rmw_dds_common::msg::ParticipantEntitiesInfo>("");
  expect_node_with_endpoints<rmw_dds_common::msg::ParticipantEntitiesInfo>("jazzy");
}

TEST(Node, RefusesNamesThatRos2WouldRefuse) {
  for (const auto* bad : {"", "Uav", "uav-1", "1uav", "uav/1"}) {
    auto options = node_options("any");
    options.names.vehicle = bad;
    EXPECT_THROW(Node{options}, std::invalid_argument) << bad;
  }
}

TEST(Node, LeavesNoSharedMemoryBehind) {
  const auto count = [] {
    return std::count_if(std::filesystem::directory_iterator("/dev/shm"), {}, [](const auto& e) {
      return e.path().filename().string().find("fastrtps_") != std::string::npos;
    });
  };
  const auto before = count();
  {
    Node node(node_options("any"));
    Writer<topics::TargetState> writer(node);
    writer.write();
  }
  EXPECT_LE(count(), before);
}

TEST(RunBounded, LeavesTheProcessWhenCleanUpHangs) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(run_bounded(0.05, [] { pause(); }), ::testing::ExitedWithCode(kCleanupFailed), "");
}

TEST(RunBounded, ReturnsWhenCleanUpIsDone) {
  bool cleaned = false;
  run_bounded(60.0, [&] { cleaned = true; });
  EXPECT_TRUE(cleaned);
}

}  // namespace
}  // namespace foretrack::testing
