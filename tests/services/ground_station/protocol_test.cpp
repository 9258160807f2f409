// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/foxglove/protocol.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace foretrack::station::foxglove {
namespace {

using Json = nlohmann::json;

template <class T>
T parsed(std::string_view text) {
  const auto message = parse_text(text);
  EXPECT_TRUE(std::holds_alternative<T>(message)) << text;
  return std::holds_alternative<T>(message) ? std::get<T>(message) : T{};
}

TEST(FoxgloveProtocol, UnderstandsSubscribeAndUnsubscribe) {
  const auto wanted = parsed<Subscribe>(
      R"({"op": "subscribe", "subscriptions": [{"id": 0, "channelId": 3}, {"id": 7, "channelId": 5}]})");
  EXPECT_EQ(wanted.subscriptions,
            (std::vector<std::pair<std::uint32_t, std::uint32_t>>{{0, 3}, {7, 5}}));
  EXPECT_EQ(parsed<Unsubscribe>(R"({"op": "unsubscribe", "subscriptionIds": [0, 7]})").ids,
            (std::vector<std::uint32_t>{0, 7}));
}

TEST(FoxgloveProtocol, CallsWhateverElseMalformedOrNotOffered) {
  for (const auto* text :
       {"", "{", "[]", "null", "7", R"("subscribe")", "{}", R"({"op": 3})", "\xff\xfe\x00",
        R"({"op": "subscribe"})", R"({"op": "subscribe", "subscriptions": {}})",
        R"({"op": "subscribe", "subscriptions": [3]})",
        R"({"op": "subscribe", "subscriptions": [{"id": -1, "channelId": 3}]})",
        R"({"op": "subscribe", "subscriptions": [{"id": 4294967296, "channelId": 3}]})",
        R"({"op": "subscribe", "subscriptions": [{"id": 1.5, "channelId": 3}]})",
        R"({"op": "unsubscribe", "subscriptionIds": ["0"]})"})
    parsed<Malformed>(text);
  EXPECT_EQ(parsed<NotOffered>(R"({"op": "advertise", "channels": []})").op, "advertise");
  EXPECT_EQ(parsed<NotOffered>(R"({"op": "getParameters"})").op, "getParameters");
}

TEST(FoxgloveProtocol, SurvivesDeepNesting) {
  std::string deep(60000, '[');
  parsed<Malformed>(deep);
  deep = std::string(30000, '[') + std::string(30000, ']');
  parsed<Malformed>(R"({"op": "subscribe", "subscriptions": )" + deep + "}");
}

TEST(FoxgloveProtocol, RefusesBinaryMessages) {
  EXPECT_TRUE(std::holds_alternative<Malformed>(parse_binary({})));
  const std::uint8_t data[] = {1, 2, 3};
  EXPECT_TRUE(std::holds_alternative<NotOffered>(parse_binary(data)));
}

TEST(FoxgloveProtocol, ChoosesTheFirstSubprotocolThatItKnows) {
  EXPECT_EQ(choose_subprotocol("foxglove.websocket.v1"), "foxglove.websocket.v1");
  EXPECT_EQ(choose_subprotocol("foxglove.sdk.v1, foxglove.websocket.v1"), "foxglove.sdk.v1");
  EXPECT_EQ(choose_subprotocol("mqtt,  foxglove.websocket.v1 "), "foxglove.websocket.v1");
  EXPECT_EQ(choose_subprotocol("foxglove.websocket.v2"), "");
  EXPECT_EQ(choose_subprotocol(""), "");
}

TEST(FoxgloveProtocol, PutsSubscriptionAndTimeBeforeASampleInLittleEndian) {
  const auto header = message_header(0x01020304, 0x1122334455667788);
  const std::array<std::uint8_t, 13> expected = {1,    4,    3,    2,    1,    0x88, 0x77,
                                                 0x66, 0x55, 0x44, 0x33, 0x22, 0x11};
  EXPECT_EQ(header, expected);
}

TEST(FoxgloveProtocol, AdvertisesAChannelWithItsSchema) {
  Channel channel;
  channel.id = 4;
  channel.topic = "/uav1/odometry";
  channel.encoding = "cdr";
  channel.schema_name = "nav_msgs/msg/Odometry";
  channel.schema_encoding = "ros2msg";
  channel.schema = "text";
  const auto json = Json::parse(advertise({channel}));
  EXPECT_EQ(json["op"], "advertise");
  EXPECT_EQ(json["channels"][0],
            Json::parse(R"({"id": 4, "topic": "/uav1/odometry", "encoding": "cdr",
                            "schemaName": "nav_msgs/msg/Odometry", "schemaEncoding": "ros2msg",
                            "schema": "text"})"));
}

TEST(FoxgloveProtocol, WritesJsonEvenOfNamesThatAreNotUtf8) {
  Channel channel;
  channel.topic = "/\xff\xfe";
  EXPECT_FALSE(Json::parse(advertise({channel}), nullptr, false).is_discarded());
}

}  // namespace
}  // namespace foretrack::station::foxglove
