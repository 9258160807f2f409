// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <optional>

#include "diagnostic_msgs/msg/DiagnosticArray.h"
#include "foretrack_msgs/msg/MissionCommand.h"
#include "foretrack_msgs/msg/TargetState.h"
#include "nav_msgs/msg/Odometry.h"
#include "px4_msgs/msg/VehicleStatus.h"
#include "services/common/px4_releases.hpp"
#include "services/common/raw.hpp"
#include "services/common/reader.hpp"
#include "services/common/topics.hpp"
#include "services/common/writer.hpp"
#include "tests/services/common/bus.hpp"
#include "tf2_msgs/msg/TFMessage.h"

namespace foretrack::testing {
namespace {

using foretrack_msgs::msg::TargetState;
namespace status = foretrack_msgs::msg::TargetState_Constants;

TargetState tracking_at(double x_m) {
  TargetState state;
  state.status(status::STATUS_TRACKING);
  state.position_m() = {x_m, 2.0, 1.0};
  return state;
}

// One writer and one reader of target/state, matched.
struct Pair {
  Node sender{node_options("sender")};
  Node receiver{node_options("receiver")};
  Writer<topics::TargetState> writer{sender};
  Reader<topics::TargetState> reader{receiver};
  Pair() {
    EXPECT_TRUE(eventually([&] { return writer.readers() == 1 && reader.writers() == 1; }));
  }
};

TEST(Reader, ReceivesWhatTheWriterWrote) {
  Pair pair;
  auto& sample = pair.writer.sample();
  sample = tracking_at(7.5);
  sample.header().frame_id("map");
  sample.covariance()[7] = 0.25;
  ASSERT_TRUE(pair.writer.write());

  const TargetState* got = nullptr;
  ASSERT_TRUE(eventually([&] { return (got = pair.reader.take_newest()) != nullptr; }));
  EXPECT_EQ(got->position_m()[0], 7.5);
  EXPECT_EQ(got->covariance()[7], 0.25);
  EXPECT_EQ(got->header().frame_id(), "map");
  EXPECT_EQ(pair.reader.stats().samples, 1u);
  EXPECT_GE(pair.reader.age_s(), 0.0);
}

TEST(Reader, TakesTheNewestAndForgetsTheRest) {
  Pair pair;
  for (int i = 1; i <= 4; ++i) pair.writer.write(tracking_at(i));
  double newest = 0.0;
  ASSERT_TRUE(eventually([&] {
    if (const auto* got = pair.reader.take_newest()) newest = got->position_m()[0];
    return newest == 4.0;
  }));
  EXPECT_EQ(pair.reader.take_newest(), nullptr);
}

TEST(Reader, GivesEachSampleInOrderWhenAsked) {
  Pair pair;
  for (int i = 1; i <= 4; ++i) pair.writer.write(tracking_at(i));
  std::vector<double> seen;
  ASSERT_TRUE(eventually([&] {
    pair.reader.take_each([&](const TargetState& s) { seen.push_back(s.position_m()[0]); });
    return seen.size() == 4;
  }));
  EXPECT_EQ(seen, (std::vector<double>{1, 2, 3, 4}));
}

TEST(Reader, KeepsAtMostItsDepthWhenNobodyTakes) {
  Pair pair;
  for (int i = 1; i <= 100; ++i) pair.writer.write(tracking_at(i));
  int taken = 0;
  double newest = 0.0;
  ASSERT_TRUE(eventually([&] {
    pair.reader.take_each([&](const TargetState& s) {
      ++taken;
      newest = s.position_m()[0];
    });
    return newest == 100.0;
  }));
  EXPECT_LE(taken, 40);
}

TEST(Reader, RefusesStampsThatCannotBeRightAndCountsThem) {
  Pair pair;
  auto malformed = tracking_at(1.0);
  malformed.header().stamp().nanosec(2000000000u);
  pair.writer.write(malformed);
  auto future = tracking_at(2.0);
  future.header().stamp(to_stamp(pair.sender.clock().now_s() + 60.0));
  pair.writer.write(future);
  pair.writer.write(tracking_at(3.0));

  std::vector<double> seen;
  ASSERT_TRUE(eventually([&] {
    pair.reader.take_each([&](const TargetState& s) { seen.push_back(s.position_m()[0]); });
    return !seen.empty();
  }));
  EXPECT_EQ(seen, std::vector<double>{3.0});
  EXPECT_EQ(pair.reader.stats().rejected_for("malformed stamp"), 1u);
  EXPECT_EQ(pair.reader.stats().rejected_for("stamp in the future"), 1u);
}

// As the converters have it: a position, or the field that is wrong.
struct Position {
  std::optional<double> x_m;
  struct Fault {
    std::string_view field;
    std::string text;
  };
  explicit operator bool() const { return x_m.has_value(); }
  double& operator*() { return *x_m; }
  Fault fault() const { return {"position_m", "position_m: not finite"}; }
};

TEST(Reader, ConvertsAndCountsWhatDoesNotConvert) {
  Pair pair;
  const auto convert = [](const TargetState& s) {
    const double x = s.position_m()[0];
    return std::isfinite(x) ? Position{x} : Position{};
  };
  pair.writer.write(tracking_at(1.0));
  pair.writer.write(tracking_at(2.0));
  pair.writer.write(tracking_at(std::nan("")));
  std::optional<double> newest;
  ASSERT_TRUE(eventually([&] {
    if (const auto value = pair.reader.take_newest_as(convert)) newest = value;
    return pair.reader.stats().rejected_for("position_m") == 1;
  }));
  EXPECT_EQ(newest, 2.0) << "a bad sample does not hide the good one before it";
  EXPECT_EQ(pair.reader.stats().samples, 2u);
}

TEST(Reader, AsksTheServiceToo) {
  Node sender(node_options("sender"));
  Node receiver(node_options("receiver"));
  Writer<topics::MissionCommand> writer(sender);
  Reader<topics::MissionCommand> reader(receiver, [](const auto& m) -> const char* {
    return m.lease_id() == "mine" ? nullptr : "not the lease holder";
  });
  ASSERT_TRUE(eventually([&] { return writer.readers() == 1 && reader.writers() == 1; }));
  writer.sample().lease_id("theirs");
  writer.write();
  writer.sample().lease_id("mine");
  writer.write();
  ASSERT_TRUE(eventually([&] { return reader.take_newest() != nullptr; }));
  EXPECT_EQ(reader.stats().rejected_for("not the lease holder"), 1u);
  EXPECT_EQ(reader.stats().samples, 1u);
}

TEST(Reader, MayHearASecondWriterAndCountIt) {
  Pair pair;
  Node other(node_options("other"));
  Writer<topics::TargetState> second(other);
  pair.reader.notice_second_writers(5.0);
  ASSERT_TRUE(eventually([&] { return second.readers() == 1 && pair.reader.writers() == 2; }));
  bool heard = false;
  ASSERT_TRUE(eventually([&] {
    pair.writer.write(tracking_at(1.0));
    return pair.reader.take_newest() != nullptr;
  }));
  EXPECT_EQ(pair.reader.stats().of_second_writers, 0u);
  EXPECT_TRUE(eventually([&] {
    second.write(tracking_at(2.0));
    pair.reader.take_each([&](const TargetState& s) { heard |= s.position_m()[0] == 2.0; });
    return heard;
  }));
  EXPECT_GT(pair.reader.stats().of_second_writers, 0u);
  EXPECT_EQ(pair.reader.stats().rejected_for(kSecondWriter), 0u);
}

TEST(Reader, HearsOneWriterAloneUntilItFallsSilent) {
  Pair pair;
  Node intruder(node_options("intruder"));
  Writer<topics::TargetState> second(intruder);
  pair.reader.pin_writer(0.5);
  ASSERT_TRUE(eventually([&] { return second.readers() == 1 && pair.reader.writers() == 2; }));
  double heard = 0.0;
  const auto hears = [&](double x_m) {
    pair.reader.take_each([&](const TargetState& state) { heard = state.position_m()[0]; });
    return heard == x_m;
  };
  ASSERT_TRUE(eventually([&] {
    pair.writer.write(tracking_at(1.0));
    return hears(1.0);
  }));
  ASSERT_TRUE(eventually([&] {
    pair.writer.write(tracking_at(1.0));
    second.write(tracking_at(2.0));
    EXPECT_TRUE(hears(1.0));
    return pair.reader.stats().rejected_for(kSecondWriter) >= 3;
  }));
  EXPECT_TRUE(eventually([&] {
    second.write(tracking_at(2.0));
    return hears(2.0);
  })) << "the first is silent, as if it had been killed";
}

TEST(Reader, SurvivesMalformedBytesAndCountsThem) {
  Node receiver(node_options("receiver"));
  Reader<topics::TargetState> reader(receiver);
  RawPeer peer("rt/uav1/target/state", "foretrack_msgs::msg::dds_::TargetState_");
  auto* writer = peer.add_writer();
  ASSERT_TRUE(eventually([&] { return reader.writers() == 1 && readers_of(writer) == 1; }));

  RawType::Bytes bad_header = {0xFF, 0xFF, 0xFF, 0xFF, 1, 2, 3, 4};
  RawType::Bytes too_short = {0x00, 0x01, 0x00, 0x00, 1, 2};
  RawType::Bytes long_string = {0x00, 0x01, 0x00, 0x00, 0,    0,    0,    0,
                                0,    0,    0,    0,    0xFF, 0xFF, 0xFF, 0x7F};
  RawType::Bytes empty;
  for (auto* bytes : {&bad_header, &too_short, &long_string}) writer->write(bytes);
  ASSERT_TRUE(eventually([&] {
    EXPECT_EQ(reader.take_newest(), nullptr);
    return reader.stats().rejected_for("malformed CDR") == 3;
  }));

  // The same reader still hears a good writer.
  Node sender(node_options("sender"));
  Writer<topics::TargetState> good(sender);
  ASSERT_TRUE(eventually([&] { return good.readers() == 1 && reader.writers() == 2; }));
  good.write(tracking_at(5.0));
  EXPECT_TRUE(eventually([&] { return reader.take_newest() != nullptr; }));
}

TEST(Reader, GetsTheLastMapThoughItJoinsLate) {
  Node sender(node_options("sender"));
  Writer<topics::StaticTransforms> writer(sender);
  writer.sample().transforms().resize(1);
  writer.sample().transforms()[0].child_frame_id("uav1/base_link");
  ASSERT_TRUE(writer.write());
  Node receiver(node_options("late"));
  Reader<topics::StaticTransforms> reader(receiver);
  const tf2_msgs::msg::TFMessage* got = nullptr;
  ASSERT_TRUE(eventually([&] { return (got = reader.take_newest()) != nullptr; }));
  EXPECT_EQ(got->transforms()[0].child_frame_id(), "uav1/base_link");
}

TEST(Writer, KeepsVehiclesApart) {
  auto other = node_options("sender");
  other.names.vehicle = "uav2";
  Node sender(other);
  Node receiver(node_options("receiver"));
  Writer<topics::TargetState> for_uav2(sender);
  Reader<topics::TargetState> of_uav1(receiver);
  // The shared topic shows that both nodes know each other.
  Writer<topics::Diagnostics> shared_out(sender);
  Reader<topics::Diagnostics> shared_in(receiver);
  ASSERT_TRUE(eventually([&] { return shared_out.readers() == 1; }));
  EXPECT_EQ(for_uav2.readers(), 0);
}

// mavros and many drivers are best effort.
TEST(ReaderWriter, BestEffortDriversAreHeardBesideReliableOnes) {
  Node node(node_options("reader"));
  Reader<topics::Odometry> reader(node);
  RawPeer peer("rt/uav1/odometry", "nav_msgs::msg::dds_::Odometry_");
  nav_msgs::msg::Odometry odometry;
  odometry.child_frame_id("base_link");
  odometry.header().stamp().sec(7);
  auto bytes = to_cdr(type_ops<nav_msgs::msg::Odometry>(), &odometry);
  RawType::Bytes raw(bytes.begin(), bytes.end());
  auto* best_effort = peer.add_writer(dds::BEST_EFFORT_RELIABILITY_QOS);
  EXPECT_TRUE(eventually([&] {
    best_effort->write(&raw);
    return reader.take_newest() != nullptr;
  }));
  Writer<topics::Odometry> reliable(node);
  EXPECT_TRUE(eventually([&] {
    reliable.sample().header().stamp().sec(8);
    reliable.write();
    const auto* got = reader.take_newest();
    return got && got->header().stamp().sec() == 8;
  }));
}

TEST(ReaderWriter, MessagesOfPx4HaveTheLayoutOfTheRelease) {
  NodeOptions of_release = node_options("px4");
  of_release.names.px4_release = "1.18";
  Node node(of_release), other(of_release), raw_node(node_options("raw"));
  Writer<topics::Px4VehicleStatus> writer(node);
  Reader<topics::Px4VehicleStatus> reader(other);
  RawReader raw(raw_node, {writer.stats().topic, "px4_msgs::msg::dds_::VehicleStatus_", false},
                "sensor");
  EXPECT_EQ(writer.stats().topic, "rt/fmu/out/vehicle_status_v4");
  auto& sent = writer.sample();
  sent.nav_state(14);
  sent.failsafe(true);
  sent.system_id(42);
  sent.pre_flight_checks_pass(true);
  px4_msgs::msg::VehicleStatus got;
  CdrBytes bytes;
  ASSERT_TRUE(eventually([&] {
    writer.write();
    if (const auto* sample = reader.take_newest()) got = *sample;
    raw.take(bytes);
    return got.system_id() == 42 && !bytes.empty();
  }));
  EXPECT_EQ(got, sent);
  const auto layout = px4_layout_of("px4_msgs::msg::dds_::VehicleStatus_", "1.18");
  EXPECT_EQ(bytes.size(), 4 + layout.bytes);
  for (const auto& field : layout.fields) {
    if (field.name == "nav_state") {
      EXPECT_EQ(bytes[4 + field.at], 14);
    }
  }
}

}  // namespace
}  // namespace foretrack::testing
