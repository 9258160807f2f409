// SPDX-License-Identifier: Apache-2.0
// Recordings of another version of a message: a small one of today's, with a schema as it was.
#include <gmock/gmock.h>

#include <fstream>
#include <thread>

#include "foretrack_msgs/msg/TargetState.h"
#include "services/common/raw.hpp"
#include "services/common/reader.hpp"
#include "services/common/topics.hpp"
#include "services/ground_station/bus/bus_warnings.hpp"
#include "services/ground_station/mcap/writer.hpp"
#include "services/ground_station/recording/replay.hpp"
#include "services/ground_station/schemas/schemas.hpp"
#include "tests/services/common/bus.hpp"
#include "tests/support/folder.hpp"

namespace foretrack::station {
namespace {

using foretrack::testing::eventually;
using foretrack::testing::Folder;
using foretrack::testing::node_options;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr char kType[] = "foretrack_msgs::msg::dds_::TargetState_";
constexpr std::size_t kLastField = 4;  // uint32 rejected_measurements

// Today's definition without its last field.
std::string schema_before() {
  std::string text(find_ros_schema(kType)->text);
  const std::string last = "uint32 rejected_measurements\n";
  const auto at = text.find(last);
  EXPECT_NE(at, std::string::npos);
  return text.erase(at, last.size());
}

CdrBytes state_at(double x_m) {
  foretrack_msgs::msg::TargetState state;
  state.position_m()[0] = x_m;
  state.rejected_measurements(77);
  return to_cdr(type_ops<foretrack_msgs::msg::TargetState>(), &state);
}

/// Ten samples a tenth of a second apart.
std::filesystem::path record(const Folder& folder, const std::string& schema,
                             std::size_t shorter_by) {
  const auto path = folder.path / "before.mcap";
  std::ofstream file(path, std::ios::binary);
  mcap::Writer writer(
      [&](std::span<const std::uint8_t> piece) {
        file.write(reinterpret_cast<const char*>(piece.data()),
                   static_cast<std::streamsize>(piece.size()));
        return true;
      },
      "test");
  writer.add_metadata("foretrack", {{"version", "0.0.9"}});
  const auto id = writer.add_channel({"/uav1/target/state",
                                      "cdr",
                                      "foretrack_msgs/msg/TargetState",
                                      "ros2msg",
                                      schema,
                                      {{"dds_topic", "rt/uav1/target/state"},
                                       {"dds_type", kType},
                                       {"topic_type_hash", "RIHS01_00"},
                                       {"qos_profile", "state"}}});
  auto data = state_at(3.5);
  data.resize(data.size() - shorter_by);
  for (std::uint64_t i = 0; i < 10; ++i) writer.write(id, 1 + i * 100'000'000, data);
  writer.finish();
  return path;
}

TEST(RecordingOfTheVersionBefore, ReplaysOntoTheBusAndWhatCameLaterIsZero) {
  const Folder folder;
  const auto path = record(folder, schema_before(), kLastField);
  Node listener(node_options("listener"));
  Reader<topics::TargetState> states(listener);
  Node node(node_options("replay"));
  Stop stop;
  const auto done = replay_onto_dds({{path, 1.0, false}, false}, node, stop);
  EXPECT_EQ(done.samples, 10u);
  EXPECT_THAT(done.warnings, ElementsAre(HasSubstr("fields that came later read as zero")));
  const foretrack_msgs::msg::TargetState* state = nullptr;
  EXPECT_TRUE(eventually([&] { return (state = states.take_newest()) != nullptr; }));
  ASSERT_TRUE(state);
  EXPECT_EQ(state->position_m()[0], 3.5);
  EXPECT_EQ(state->rejected_measurements(), 0u);
}

TEST(RecordingOfAnotherVersion, IsNamedAndItsChangedTypeIsLeftOffTheBus) {
  const Folder folder;
  std::string changed(find_ros_schema(kType)->text);
  changed.replace(changed.find("uint8 status\n"), 12, "uint16 status");
  const auto path = record(folder, changed, 0);
  Node node(node_options("replay"));
  Stop stop;
  const auto done = replay_onto_dds({{path, 10.0, false}, false}, node, stop);
  EXPECT_EQ(done.samples, 0u);
  EXPECT_THAT(done.warnings, ElementsAre(::testing::AllOf(HasSubstr("/uav1/target/state"),
                                                          HasSubstr("by foretrack 0.0.9"),
                                                          HasSubstr("left out"))));
}

TEST(RecordingOfAnotherVersion, IsShownWithTheSchemaThatItWasRecordedWith) {
  const Folder folder;
  const auto schema = schema_before();
  Stop stop;
  Channel opened;
  Replay replay({record(folder, schema, kLastField), 100.0, false},
                Outlet{[&](const Channel& channel) { opened = channel; }, [](std::uint32_t) {},
                       [&](const auto&) { stop.request(); }});
  replay.run(stop);
  EXPECT_EQ(opened.schema, schema);
  EXPECT_THAT(replay.warnings(), ElementsAre(HasSubstr("another version of")));
}

Bytes stamped(std::int32_t sec, std::uint32_t nanosec) {
  Bytes bytes = {0, 1, 0, 0};
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(sec >> (8 * i)));
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(nanosec >> (8 * i)));
  return bytes;
}

TEST(ClockOfAVehicle, IsKnownFromWhatIsStampedWhenItIsSent) {
  constexpr std::int64_t kCame_ns = 1'700'000'000'500'000'000;
  EXPECT_NEAR(*clock_ahead_s(stamped(1'700'000'002, 0), kCame_ns), 1.5, 1e-6);
  EXPECT_NEAR(*clock_ahead_s(stamped(1'700'000'000, 499'000'000), kCame_ns), -0.001, 1e-6);
  EXPECT_EQ(clock_ahead_s(stamped(42, 0), kCame_ns), std::nullopt) << "simulated time";
  EXPECT_EQ(clock_ahead_s({0, 1, 0}, kCame_ns), std::nullopt);
}

TEST(ClockOfAVehicle, ThatDiffersIsAWarning) {
  const Node node(node_options("station"));
  EXPECT_THAT(warnings_of(node, {{"uav1", 2.04}, {"uav2", -0.01}}),
              ElementsAre(HasSubstr("clock of uav1 is +2.0 s off")));
}

}  // namespace
}  // namespace foretrack::station
