// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/hub/hub.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace foretrack::station {
namespace {

using Json = nlohmann::json;

Channel channel(std::uint32_t id, bool latched = false) {
  Channel c;
  c.id = id;
  c.topic = "/t" + std::to_string(id);
  c.latched = latched;
  return c;
}

Sample sample(std::uint32_t channel, std::size_t bytes, std::uint8_t mark = 0) {
  return {channel, 1, std::make_shared<const Bytes>(bytes, mark)};
}

/// A client whose socket takes a message whenever the test says so.
struct Reader {
  Reader(Hub& hub, double now_s)
      : client(hub.join("test", {[] {}, [this](const std::string& why) { closed = why; }}, now_s)) {
  }
  void subscribe(std::uint32_t id, std::uint32_t to, double now_s) {
    const Json message = {{"op", "subscribe"},
                          {"subscriptions", {{{"id", id}, {"channelId", to}}}}};
    client->on_text(message.dump(), now_s);
  }
  std::vector<Frame> take_all(double now_s) {
    std::vector<Frame> frames;
    while (auto frame = client->next(now_s)) frames.push_back(std::move(*frame));
    return frames;
  }
  std::shared_ptr<Client> client;
  std::string closed;
};

TEST(Hub, TellsANewClientOfItselfAndAllChannels) {
  Hub hub("station", "1.2", {});
  hub.open(channel(1));
  hub.open(channel(2));
  Reader reader(hub, 0.0);
  const auto frames = reader.take_all(0.0);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(Json::parse(*frames[0].text)["op"], "serverInfo");
  EXPECT_EQ(Json::parse(*frames[1].text)["channels"].size(), 2u);
}

TEST(Hub, APagesConnectionForPicturesIsNoSecondOneWhoWatches) {
  Hub hub("station", "1", {});
  hub.open(channel(1));
  auto picture = channel(2);
  picture.topic = "/uav1/camera/ground/image/compressed";
  hub.open(picture);
  Reader page(hub, 0.0), pictures(hub, 0.0);
  page.subscribe(1, 1, 0.0);
  pictures.subscribe(1, 2, 0.0);
  const auto clients = hub.clients(0.0);
  ASSERT_EQ(clients.size(), 2u);
  EXPECT_TRUE(clients[0].watches);
  EXPECT_FALSE(clients[1].watches);
}

TEST(Hub, TellsWhoPublishesAndSubscribesToThoseWhoAskAndThenWhatChanged) {
  Hub hub("station", "1", {});
  hub.set_graph({{"/a", {{"planning"}, {"gate"}}}, {"/b", {{"mapping"}, {}}}});
  Reader asks(hub, 0.0), does_not(hub, 0.0);
  asks.client->on_text(R"({"op": "subscribeConnectionGraph"})", 0.0);
  auto frames = asks.take_all(0.0);
  ASSERT_EQ(frames.size(), 3u);
  const auto all = Json::parse(*frames[2].text);
  EXPECT_EQ(all["op"], "connectionGraphUpdate");
  EXPECT_EQ(all["publishedTopics"].size(), 2u);
  EXPECT_EQ(all["subscribedTopics"], Json::parse(R"([{"name": "/a", "subscriberIds": ["gate"]}])"));
  hub.set_graph({{"/a", {{}, {"gate"}}}});
  frames = asks.take_all(0.0);
  ASSERT_EQ(frames.size(), 1u);
  const auto news = Json::parse(*frames[0].text);
  EXPECT_EQ(news["publishedTopics"], Json::parse(R"([{"name": "/a", "publisherIds": []}])"));
  EXPECT_EQ(news["subscribedTopics"], Json::array());
  EXPECT_EQ(news["removedTopics"], Json({"/b"}));
  hub.set_graph({{"/a", {{}, {"gate"}}}});
  asks.client->on_text(R"({"op": "unsubscribeConnectionGraph"})", 0.0);
  hub.set_graph({});
  EXPECT_TRUE(asks.take_all(0.0).empty());
  EXPECT_EQ(does_not.take_all(0.0).size(), 2u);
}

TEST(Hub, SendsAClientWhatItSubscribedToAndNothingElse) {
  Hub hub("station", "1", {});
  hub.open(channel(1));
  hub.open(channel(2));
  Reader reader(hub, 0.0);
  reader.take_all(0.0);
  reader.subscribe(9, 2, 0.0);
  hub.deliver({sample(1, 8), sample(2, 8)}, 0.0);
  const auto frames = reader.take_all(0.0);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].header[1], 9);
  EXPECT_EQ(hub.wanted(), std::set<std::uint32_t>{2});
  reader.client->on_text(R"({"op": "unsubscribe", "subscriptionIds": [9]})", 0.0);
  hub.deliver({sample(2, 8)}, 0.0);
  EXPECT_TRUE(reader.take_all(0.0).empty());
}

TEST(Hub, GivesALateSubscriberTheLastSampleOfALatchedChannel) {
  Hub hub("station", "1", {});
  hub.open(channel(1, true));
  hub.deliver({sample(1, 8, 1), sample(1, 8, 2)}, 0.0);
  Reader reader(hub, 5.0);
  reader.take_all(5.0);
  reader.subscribe(0, 1, 5.0);
  const auto frames = reader.take_all(5.0);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].data->front(), 2);
}

TEST(Hub, ASlowClientSkipsToTheNewestAndAFastOneGetsEverything) {
  Hub hub("station", "1", {});
  hub.open(channel(1));
  Reader slow(hub, 0.0), fast(hub, 0.0);
  slow.take_all(0.0), fast.take_all(0.0);
  slow.subscribe(0, 1, 0.0), fast.subscribe(0, 1, 0.0);
  std::size_t fast_got = 0;
  for (int i = 1; i <= 100; ++i) {
    hub.deliver({sample(1, 8, static_cast<std::uint8_t>(i))}, 0.01 * i);
    fast_got += fast.take_all(0.01 * i).size();
  }
  EXPECT_EQ(fast_got, 100u);
  const auto frames = slow.take_all(1.01);
  EXPECT_LT(frames.size(), 20u);  // those of the last 0.15 s
  ASSERT_FALSE(frames.empty());
  EXPECT_EQ(frames.back().data->front(), 100);
}

// A link of 15 kB/s for a map of 50 kB twice a second and positions of 100 bytes, 20 times.
TEST(Hub, OnASlowLinkAMapLeavesMostOfTheTimeToSmallTopics) {
  Hub hub("station", "1", {});
  hub.open(channel(1));
  hub.open(channel(2));
  Reader reader(hub, 0.0);
  reader.take_all(0.0);
  reader.subscribe(1, 1, 0.0);
  reader.subscribe(2, 2, 0.0);
  double free_s = 0.0, maps = 0.0, positions = 0.0, longest_s = 0.0, last_s = 0.0;
  for (int i = 0; i < 1200; ++i) {
    const double now_s = 0.05 * i;
    if (i % 10 == 0) hub.deliver({sample(1, 50'000)}, now_s);
    hub.deliver({sample(2, 100)}, now_s);
    while (free_s < now_s + 0.05) {
      free_s = std::max(free_s, now_s);
      const auto frame = reader.client->next(free_s);
      if (!frame) break;
      free_s += static_cast<double>(frame->bytes()) / 15e3;
      if (frame->header[1] == 1) {
        ++maps;
        continue;
      }
      ++positions;
      longest_s = std::max(longest_s, free_s - last_s);
      last_s = free_s;
    }
  }
  EXPECT_GE(maps, 5);         // 50 kB take 3.3 s, and then rest for 6.7 s
  EXPECT_GT(positions, 700);  // of 1200
  EXPECT_LT(longest_s, 3.6);
}

TEST(Hub, WhatWaitsForAClientStaysWithinItsBudget) {
  HubLimits limits;
  limits.client_budget_bytes = 100'000;
  Hub hub("station", "1", limits);
  hub.open(channel(1));
  Reader reader(hub, 0.0);
  reader.take_all(0.0);
  reader.subscribe(0, 1, 0.0);
  for (int i = 0; i < 50; ++i) {
    hub.deliver({sample(1, 30'000, static_cast<std::uint8_t>(i))}, 0.01 * i);
    EXPECT_LE(hub.clients(0.0)[0].waiting_bytes, 100'000u);
  }
  EXPECT_GT(hub.clients(0.0)[0].dropped, 40u);
  EXPECT_EQ(reader.take_all(0.5).back().data->front(), 49);
}

TEST(Hub, ClosesAClientThatTakesNothingForTenSeconds) {
  Hub hub("station", "1", {});
  hub.open(channel(1));
  Reader reader(hub, 0.0);
  hub.check(9.0);
  EXPECT_EQ(reader.closed, "");
  hub.check(10.5);
  EXPECT_NE(reader.closed.find("too slow"), std::string::npos);
}

TEST(Hub, ClosesAClientThatFloodsAndOneWhoseTextsExceedTheBudget) {
  HubLimits limits;
  limits.messages_s = 10.0;
  limits.client_budget_bytes = 2000;
  Hub hub("station", "1", limits);
  Reader flood(hub, 0.0), full(hub, 0.0);
  for (int i = 0; i < 11; ++i) flood.client->on_text("{}", 0.0), flood.take_all(0.0);
  EXPECT_EQ(flood.closed, "too many messages");
  for (std::uint32_t i = 1; i < 100 && full.closed.empty(); ++i) hub.open(channel(i));
  EXPECT_NE(full.closed.find("too slow"), std::string::npos);
}

TEST(Hub, LimitsTheBandwidthOfATopicAndShowsIt) {
  HubLimits limits;
  limits.topic_bytes_s = 1e5;
  Hub hub("station", "1", limits);
  hub.open(channel(1));
  hub.open(channel(2));
  Reader reader(hub, 0.0);
  reader.take_all(0.0);
  reader.subscribe(0, 1, 0.0);
  std::size_t bytes = 0;
  for (int i = 0; i < 1000; ++i) {
    hub.deliver({sample(1, 10'000), sample(2, 10)}, 0.01 * i);
    for (const auto& frame : reader.take_all(0.01 * i)) bytes += frame.data->size();
  }
  EXPECT_NEAR(static_cast<double>(bytes), 1e5 * 11.0, 2e4);  // 10 s, and the first second's worth
  EXPECT_TRUE(hub.limited(1, 10.0));
  EXPECT_FALSE(hub.limited(2, 10.0));
}

TEST(Hub, AClosedChannelEndsItsSubscriptions) {
  Hub hub("station", "1", {});
  hub.open(channel(1));
  Reader reader(hub, 0.0);
  reader.subscribe(0, 1, 0.0);
  hub.deliver({sample(1, 8)}, 0.0);
  hub.close(1);
  std::vector<std::string> ops;
  for (const auto& frame : reader.take_all(0.0)) {
    ASSERT_TRUE(frame.text) << "a sample of a channel that is closed";
    ops.push_back(Json::parse(*frame.text)["op"]);
  }
  EXPECT_EQ(ops.back(), "unadvertise");
  EXPECT_TRUE(hub.wanted().empty());
}

TEST(Hub, RefusesToSubscribeTwiceOrToNothing) {
  Hub hub("station", "1", {});
  hub.open(channel(1));
  Reader reader(hub, 0.0);
  reader.subscribe(0, 1, 0.0);
  reader.take_all(0.0);
  for (const auto& [id, to] : {std::pair{0u, 1u}, {1u, 1u}, {2u, 77u}}) {
    reader.subscribe(id, to, 0.0);
    const auto frames = reader.take_all(0.0);
    ASSERT_EQ(frames.size(), 1u);
    EXPECT_EQ(Json::parse(*frames[0].text)["op"], "status");
  }
}

}  // namespace
}  // namespace foretrack::station
