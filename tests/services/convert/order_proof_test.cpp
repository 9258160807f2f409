// SPDX-License-Identifier: Apache-2.0
#include "services/convert/order_proof.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace foretrack {
namespace {

using Order = foretrack_msgs::msg::MissionCommand;

Order hold() {
  Order order;
  order.header().stamp().sec(100);
  order.id(7);
  order.command(1);
  order.operator_id("ada");
  return order;
}

TEST(OrderProof, HoldsForTheLeasesHolderAlone) {
  const LeaseKey ada, bob;
  EXPECT_NE(ada.id(), bob.id());
  Order order = hold();
  ada.sign("uav1", order);
  EXPECT_EQ(order.lease_id().c_str(), ada.id());
  EXPECT_TRUE(is_proved("uav1", order));
  order.lease_id(bob.id());
  EXPECT_FALSE(is_proved("uav1", order));
}

TEST(OrderProof, CoversEveryFieldAndTheVehicle) {
  const LeaseKey key;
  const std::vector<std::function<void(Order&)>> forgeries = {
      [](Order& o) { o.header().stamp().sec(101); },
      [](Order& o) { o.header().stamp().nanosec(1); },
      [](Order& o) { o.id(8); },
      [](Order& o) { o.command(3); },
      [](Order& o) { o.operator_id("eve"); },
      [](Order& o) { o.altitude_max_m(500.0); },
      [](Order& o) {
        o.fence_m({0.0, 0.0});
      },
      [](Order& o) { o.person_id(3); },
      [](Order& o) { o.framing().distance_m(3.0); },
      [](Order& o) { o.framing().height_m(3.0); },
      [](Order& o) { o.framing().bearing_rad(3.0); },
      [](Order& o) { o.framing().circling_radps(0.3); },
      [](Order& o) { o.proof()[0] ^= 1; }};
  for (const auto& forge : forgeries) {
    Order order = hold();
    key.sign("uav1", order);
    forge(order);
    EXPECT_FALSE(is_proved("uav1", order));
  }
  Order order = hold();
  key.sign("uav1", order);
  EXPECT_FALSE(is_proved("uav2", order)) << "played to another vehicle";
}

TEST(OrderProof, RefusesLeasesThatAreNoKeys) {
  for (const std::string& id :
       {std::string(), std::string("ada's"), std::string(64, 'x'), std::string(63, 'a')}) {
    Order order = hold();
    order.lease_id(id);
    EXPECT_FALSE(is_proved("uav1", order)) << id;
  }
}

}  // namespace
}  // namespace foretrack
