// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/recording/recorder.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"
#include "services/common/type_hash.hpp"
#include "services/ground_station/mcap/reader.hpp"
#include "services/ground_station/schemas/schemas.hpp"
#include "tests/support/folder.hpp"

namespace foretrack::station {
namespace {

using testing::Folder;

Channel channel(std::uint32_t id, const std::string& topic, bool latched = false) {
  Channel c;
  c.id = id;
  c.topic = topic;
  c.wire = "rt" + topic;
  c.type = "pkg::msg::dds_::T_";
  c.encoding = "cdr";
  c.schema_name = "pkg/msg/T";
  c.schema_encoding = "ros2msg";
  c.schema = "int32 x";
  c.profile = latched ? "latched" : "state";
  c.latched = latched;
  return c;
}

std::vector<Sample> sample(std::uint32_t channel, std::size_t bytes = 1000) {
  Bytes data(bytes);
  static Random random(1);  // what does not compress
  for (auto& byte : data) byte = static_cast<std::uint8_t>(random.next());
  return {{channel, now_ns(), std::make_shared<const Bytes>(std::move(data))}};
}

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::map<std::string, int> counts_of(const std::filesystem::path& file) {
  mcap::Reader reader(file);
  std::map<std::string, int> counts;
  while (const auto message = reader.next()) ++counts[reader.channels().at(message->channel).topic];
  EXPECT_TRUE(reader.complete()) << file << reader.fault();
  return counts;
}

// What `ros2 bag play` asks of a file: ROS 2's name of the type and its definition, and how it was
// offered.
TEST(Recorder, RecordsOurTypesAsRos2KnowsThem) {
  const Folder folder;
  RecorderOptions options;
  options.folder = folder.path;
  Recorder recorder(options);
  auto own = channel(1, "/uav1/target/state");
  own.type = "foretrack_msgs::msg::dds_::TargetState_";
  const auto* live = find_schema(own.type);
  own.schema_name = live->name;
  own.schema_encoding = live->encoding;
  own.schema = live->text;
  recorder.open(own);
  EXPECT_EQ(recorder.start(), "");
  recorder.samples(sample(1));
  recorder.stop();
  mcap::Reader reader(files_in(folder.path).at(0));
  while (reader.next()) {
  }
  const auto& info = reader.channels().at(1);
  EXPECT_EQ(info.schema_name, "foretrack_msgs/msg/TargetState");
  EXPECT_EQ(info.schema_encoding, "ros2msg");
  EXPECT_NE(info.schema.find("float64[3] position_m"), std::string::npos);
  EXPECT_EQ(info.metadata.at("topic_type_hash"), type_hash_of(own.type));
  EXPECT_NE(info.metadata.at("offered_qos_profiles").find("reliability: 1, durability: 2"),
            std::string::npos);
}

TEST(Recorder, LeavesOutWhatItIsToldTo) {
  const Folder folder;
  RecorderOptions options;
  options.folder = folder.path;
  options.leave_out = [](const Channel& c) { return c.topic == "/b"; };
  Recorder recorder(options);
  recorder.open(channel(1, "/a"));
  recorder.open(channel(2, "/b"));
  EXPECT_EQ(recorder.start(), "");
  EXPECT_EQ(recorder.wanted(), (std::set<std::uint32_t>{1}));
  recorder.samples(sample(1));
  recorder.samples(sample(2));
  recorder.stop();
  EXPECT_EQ(counts_of(files_in(folder.path).at(0)), (std::map<std::string, int>{{"/a", 1}}));
}

TEST(Recorder, RecordsEverySampleBetweenStartAndStop) {
  const Folder folder;
  RecorderOptions options;
  options.folder = folder.path;
  options.metadata = {{"foretrack", {{"version", "7"}}}};
  Recorder recorder(options);
  recorder.open(channel(1, "/a"));
  recorder.open(channel(2, "/b"));
  recorder.samples(sample(1));
  EXPECT_EQ(recorder.start(), "");
  EXPECT_EQ(recorder.wanted(), (std::set<std::uint32_t>{1, 2}));
  for (int i = 0; i < 500; ++i) recorder.samples(sample(1 + i % 2));
  recorder.stop();
  recorder.samples(sample(1));
  const auto files = files_in(folder.path);
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(counts_of(files[0]), (std::map<std::string, int>{{"/a", 250}, {"/b", 250}}));
  mcap::Reader reader(files[0]);
  while (reader.next()) {
  }
  EXPECT_EQ(reader.metadata().at("foretrack").at("version"), "7");
  EXPECT_EQ(reader.channels().at(1).metadata.at("dds_type"), "pkg::msg::dds_::T_");
}

TEST(Recorder, SplitsAtTheSizeAndLosesNothingBetweenFiles) {
  const Folder folder;
  RecorderOptions options;
  options.folder = folder.path;
  options.split_bytes = 2'000'000;
  Recorder recorder(options);
  recorder.open(channel(1, "/a"));
  ASSERT_EQ(recorder.start(), "");
  for (int i = 0; i < 100; ++i) recorder.samples(sample(1, 100'000));
  recorder.stop();
  int total = 0;
  const auto files = files_in(folder.path);
  EXPECT_GE(files.size(), 4u);
  for (const auto& file : files) {
    total += counts_of(file)["/a"];
    EXPECT_LT(std::filesystem::file_size(file), 5'000'000u);
  }
  EXPECT_EQ(total, 100);
}

TEST(Recorder, BeginsWithWhatWasLatchedBefore) {
  const Folder folder;
  RecorderOptions options;
  options.folder = folder.path;
  Recorder recorder(options);
  recorder.open(channel(1, "/tf_static", true));
  recorder.samples(sample(1));
  ASSERT_EQ(recorder.start(), "");
  recorder.stop();
  EXPECT_EQ(counts_of(files_in(folder.path).at(0))["/tf_static"], 1);
}

TEST(Recorder, RecordsOnlyTheTopicsThatWereChosen) {
  const Folder folder;
  RecorderOptions options;
  options.folder = folder.path;
  options.topics = {"odometry"};
  Recorder recorder(options);
  recorder.open(channel(1, "/uav1/odometry"));
  recorder.open(channel(2, "/uav1/camera"));
  ASSERT_EQ(recorder.start(), "");
  EXPECT_EQ(recorder.wanted(), std::set<std::uint32_t>{1});
  recorder.samples(sample(1)), recorder.samples(sample(2));
  recorder.stop();
  EXPECT_EQ(counts_of(files_in(folder.path).at(0)).size(), 1u);
}

TEST(Recorder, SaysWhyItCannotRecord) {
  RecorderOptions options;
  options.folder = "/proc/nowhere";
  Recorder recorder(options);
  EXPECT_NE(recorder.start().find("/proc/nowhere"), std::string::npos);
  EXPECT_FALSE(recorder.status());
}

TEST(Recorder, LosesSamplesRatherThanMemoryWhenTheDiskIsSlow) {
  const Folder folder;
  RecorderOptions options;
  options.folder = folder.path;
  options.queue_bytes = 50'000;
  Recorder recorder(options);
  recorder.open(channel(1, "/a"));
  ASSERT_EQ(recorder.start(), "");
  recorder.samples(sample(1, 60'000));
  ASSERT_TRUE(recorder.status());
  EXPECT_EQ(recorder.status()->lost, 1u);
  recorder.stop();
}

}  // namespace
}  // namespace foretrack::station
