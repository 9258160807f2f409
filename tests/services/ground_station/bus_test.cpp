// SPDX-License-Identifier: Apache-2.0
// The bus side on real DDS: topics that come and go, any type, and the bytes as they were sent.
#include "services/ground_station/bus/bus.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "foxglove_msgs/msg/CompressedVideo.h"
#include "nav_msgs/msg/Odometry.h"
#include "services/common/topics.hpp"
#include "services/common/writer.hpp"
#include "services/launch/domain.hpp"

namespace foretrack::station {
namespace {

NodeOptions options(const FreeDomain& domain, const std::string& vehicle) {
  NodeOptions o;
  o.service = "test";
  o.names.vehicle = vehicle;
  o.domain_id = domain.id();
  return o;
}

class BusOnDds : public ::testing::Test {
 protected:
  BusOnDds() : thread_([this] { bus_.run(stop_); }) {}
  ~BusOnDds() override {
    stop_.request();
    thread_.join();
  }
  template <class Condition, class Work>
  bool until(Condition condition, Work work) {
    for (int i = 0; i < 500; ++i) {
      work();
      {
        const std::lock_guard lock(mutex_);
        if (condition()) return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
  }
  const Channel* channel(const std::string& topic) const {
    for (const auto& [id, c] : channels_)
      if (c.topic == topic) return &c;
    return nullptr;
  }
  // Shared, as the bus goes on and puts another one in its place.
  std::shared_ptr<const Bytes> last(const std::string& topic) const {
    const auto* c = channel(topic);
    const auto it = c ? samples_.find(c->id) : samples_.end();
    return it == samples_.end() ? nullptr : it->second;
  }

  FreeDomain domain_;
  std::mutex mutex_;
  std::map<std::uint32_t, Channel> channels_;
  std::map<std::uint32_t, std::shared_ptr<const Bytes>> samples_;
  std::shared_ptr<Node> node_ = std::make_shared<Node>(options(domain_, "station"));
  Bus bus_{node_,
           {[this](const Channel& c) {
              const std::lock_guard lock(mutex_);
              channels_[c.id] = c;
            },
            [this](std::uint32_t id) {
              const std::lock_guard lock(mutex_);
              channels_.erase(id);
            },
            [this](const std::vector<Sample>& samples) {
              const std::lock_guard lock(mutex_);
              for (const auto& s : samples) samples_[s.channel] = s.data;
            }}};
  Stop stop_;
  std::thread thread_;
};

TEST_F(BusOnDds, PassesOnTheBytesOfEveryVehicleThatJoins) {
  for (const std::string name : {"uav1", "uav2"}) {
    Node vehicle(options(domain_, name));
    Writer<topics::Odometry> writer(vehicle);
    writer.sample().child_frame_id(name);
    writer.sample().pose().pose().position().x(12.5);
    std::shared_ptr<const Bytes> bytes;
    ASSERT_TRUE(until([&] { return (bytes = last("/" + name + "/odometry")) != nullptr; },
                      [&] { writer.write(); }));
    const auto& c = *channel("/" + name + "/odometry");
    EXPECT_EQ(c.schema_name, "nav_msgs/msg/Odometry");
    EXPECT_EQ(c.schema_encoding, "ros2msg");
    const auto ops = type_ops<nav_msgs::msg::Odometry>();
    EXPECT_EQ(*bytes, to_cdr(ops, &writer.sample()));
    nav_msgs::msg::Odometry read;
    ASSERT_TRUE(from_cdr(ops, *bytes, &read));
    EXPECT_EQ(read.pose().pose().position().x(), 12.5);
  }
  EXPECT_TRUE(until([&] { return bus_.vehicles().size() == 2; }, [] {}));
}

TEST_F(BusOnDds, ReadsPicturesForTheGroundOnlyWhileSomebodyWantsThem) {
  Node vehicle(options(domain_, "uav1"));
  Writer<topics::GroundVideo> video(vehicle);
  Writer<topics::Odometry> odometry(vehicle);
  const auto write = [&] { return video.write() && odometry.write(); };
  const std::string topic = "/uav1/camera/ground/video";
  ASSERT_TRUE(until([&] { return last(topic) && last("/uav1/odometry"); }, write));
  ASSERT_TRUE(until([&] { return video.readers() == 0; }, write)) << "nobody wants it";
  EXPECT_EQ(odometry.readers(), 1);
  ASSERT_TRUE(channel(topic)) << "it is still offered";
  bus_.want({channel(topic)->id});
  {
    const std::lock_guard lock(mutex_);
    samples_.clear();
  }
  ASSERT_TRUE(until([&] { return last(topic) && video.readers() == 1; }, write));
}

TEST_F(BusOnDds, PassesOnTypesThatNobodyKnowsAndLatchedOnesToLateComers) {
  Node other(options(domain_, "other"));
  RawWriter writer(other, {"rt/anything", "some::msg::dds_::Type_", false}, "latched");
  const CdrBytes bytes = {0, 1, 0, 0, 42, 43, 44, 45};
  writer.write(bytes);  // before the bus has discovered it
  ASSERT_TRUE(until([&] { return last("/anything"); }, [] {}));
  EXPECT_EQ(*last("/anything"), bytes);
  EXPECT_TRUE(channel("/anything")->latched);
  EXPECT_EQ(channel("/anything")->schema_encoding, "");
}

TEST_F(BusOnDds, HearsBestEffortWritersAndShowsWhatDoesNotFit) {
  Node other(options(domain_, "uav1"));
  RawWriter fit(other, {"rt/uav1/odometry", "nav_msgs::msg::dds_::Odometry_", false}, "sensor");
  RawWriter foreign(other, {"rt/uav1/plan/path", "other::msg::dds_::Path_", false}, "state");
  RawReader strict(other, {"rt/uav1/odometry", "nav_msgs::msg::dds_::Odometry_", false}, "state");
  ASSERT_TRUE(until([&] { return last("/uav1/odometry"); },
                    [&] {
                      fit.write({0, 1, 0, 0, 1, 2, 3, 4});
                    }));
  ASSERT_TRUE(until([&] { return bus_.topics().size() == 2; }, [] {}));
  for (const auto& topic : bus_.topics()) {
    EXPECT_EQ(topic.qos_mismatch, topic.topic == "/uav1/odometry") << topic.topic;
    EXPECT_EQ(topic.foreign_type.empty(), topic.topic == "/uav1/odometry") << topic.topic;
  }
}

TEST_F(BusOnDds, KnowsWhoIsThereAndForHowLongItMayBeSilent) {
  {
    Node other(options(domain_, "uav1"));
    ASSERT_TRUE(until([&] { return node_->peers().size() == 1; }, [] {}));
    EXPECT_EQ(node_->peers()[0].name, "uav1/test");
    EXPECT_EQ(node_->peers()[0].lease_s, node_->lease_s());
    EXPECT_EQ(node_->lease_s(), 20.0);
  }
  EXPECT_TRUE(until([&] { return node_->peers().empty(); }, [] {}));
}

TEST(Raw, MalformedBytesAreRefusedNotThrown) {
  nav_msgs::msg::Odometry sample;
  const auto ops = type_ops<nav_msgs::msg::Odometry>();
  EXPECT_FALSE(from_cdr(ops, {}, &sample));
  EXPECT_FALSE(from_cdr(ops, {9, 9}, &sample));
  EXPECT_FALSE(from_cdr(ops, {0, 1, 0, 0, 255, 255, 255, 255, 255, 255, 255, 255}, &sample));
}

}  // namespace
}  // namespace foretrack::station
