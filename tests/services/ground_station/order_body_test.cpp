// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/api/order_body.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace foretrack::station {
namespace {

Converted<MissionCommand> read(const std::string& body) {
  return read_order(nlohmann::ordered_json::parse(body));
}

TEST(OrderBody, KnowsThePlainOrders) {
  const auto order = read(R"({"command": "take_off"})");
  ASSERT_TRUE(order);
  EXPECT_EQ(order->order, MissionOrder::kTakeOff);
}

TEST(OrderBody, NamesWhomToFollow) {
  const auto order = read(R"({"command": "follow", "person_id": 12})");
  ASSERT_TRUE(order);
  EXPECT_EQ(order->order, MissionOrder::kFollow);
  EXPECT_EQ(order->person_id, 12u);
}

TEST(OrderBody, LeavesFreeWhatOfAFramingIsNullOrLeftOut) {
  const auto order =
      read(R"({"command": "framing", "distance_m": 3, "height_m": null, "circling_radps": -0.2})");
  ASSERT_TRUE(order);
  EXPECT_EQ(order->order, MissionOrder::kSetFraming);
  EXPECT_EQ(order->framing, (Framing{.distance_m = 3.0, .circling_rad_s = -0.2}));
}

TEST(OrderBody, TakesBounds) {
  const auto order =
      read(R"({"command": "bounds", "fence_m": [[0, 0], [9, 0], [9, 9.5]], "altitude_max_m": 12})");
  ASSERT_TRUE(order);
  EXPECT_EQ(order->order, MissionOrder::kSetBounds);
  EXPECT_EQ(order->bounds.corner_count, 3);
  EXPECT_EQ(order->bounds.corners_enu_m[2], (FlightBounds::Corner{9.0, 9.5}));
  EXPECT_EQ(order->bounds.altitude_max_m, 12.0);
  EXPECT_TRUE(are_valid(order->bounds));
}

TEST(OrderBody, TakesAPlaceToReturnTo) {
  const auto order = read(R"({"command": "return_place", "position_m": [3, -4.5]})");
  ASSERT_TRUE(order);
  EXPECT_EQ(order->order, MissionOrder::kSetReturnPlace);
  EXPECT_EQ(order->return_place_enu_m, (FlightBounds::Corner{3.0, -4.5}));
}

TEST(OrderBody, RefusesWhatIsNone) {
  for (const char* body :
       {R"({})", R"({"command": 7})", R"({"command": "lease"})", R"({"command": "follow"})",
        R"({"command": "follow", "person_id": -1})", R"({"command": "follow", "person_id": 1.5})",
        R"({"command": "follow", "person_id": 4294967296})",
        R"({"command": "framing", "distance_m": "far"})",
        R"({"command": "framing", "height_m": 1e300})", R"({"command": "bounds", "fence_m": 3})",
        R"({"command": "bounds", "fence_m": [[1, 2, 3]]})",
        R"({"command": "bounds", "fence_m": [[1, "2"]]})",
        R"({"command": "bounds", "fence_m": [[1, 1e300]]})", R"({"command": "return_place"})",
        R"({"command": "return_place", "position_m": [1]})",
        R"({"command": "return_place", "position_m": [1, 1e300]})"})
    EXPECT_FALSE(read(body)) << body;
  std::string corners = "[0, 0]";
  for (int i = 0; i < 32; ++i) corners += ", [0, 0]";
  EXPECT_FALSE(read(R"({"command": "bounds", "fence_m": [)" + corners + "]}"));
}

}  // namespace
}  // namespace foretrack::station
