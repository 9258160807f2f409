// SPDX-License-Identifier: Apache-2.0
#include "services/operator/order_sender.hpp"

#include "core/safety/autopilot_watch.hpp"
#include "tests/services/common/bus.hpp"

namespace foretrack::testing {
namespace {

/// A gate that gives every start up, and says why the mission ended.
class ReluctantGate {
 public:
  int starts = 0;
  MissionEnd end = MissionEnd::kNotReady;
  std::uint64_t other_order = 0;  // by somebody else; 0: none

  void step() {
    orders_.take_each([this](const foretrack_msgs::msg::MissionCommand& order) {
      ++starts;
      state_.command_id(order.id());
      state_.command_result(static_cast<std::uint8_t>(MissionResult::kAccepted));
    });
    if (other_order != 0) state_.command_id(other_order);
    state_.phase(static_cast<std::uint8_t>(MissionPhase::kIdle));
    state_.mission_end(static_cast<std::uint8_t>(end));
    state_.text("idle");
    writer_.sample() = state_;
    writer_.write();
  }

 private:
  Node node_{node_options("safety_gate")};
  Reader<topics::MissionCommand> orders_{node_};
  Writer<topics::SafetyState> writer_{node_};
  foretrack_msgs::msg::SafetyState state_;
};

class Insisting : public ::testing::Test {
 protected:
  Insisting() { sender_.insist(); }
  bool gets_starts(int n, double deadline_s = 10.0) {
    return eventually(
        [&] {
          gate_.step();
          sender_.update();
          std::this_thread::sleep_for(std::chrono::milliseconds(20));
          return gate_.starts >= n;
        },
        deadline_s);
  }

  ReluctantGate gate_;
  Node node_{node_options("operator")};
  OrderSender sender_{node_, {.order = MissionOrder::kStart, .operator_name = "test"}};
};

TEST_F(Insisting, AStartThatCameToNothingIsGivenAgain) {
  EXPECT_TRUE(gets_starts(3));
}

TEST_F(Insisting, EndsWithAPilotsDeed) {
  ASSERT_TRUE(gets_starts(1));
  gate_.end = MissionEnd::kSticks;
  gets_starts(1000, 0.5);  // what was under way
  const int starts = gate_.starts;
  EXPECT_FALSE(gets_starts(starts + 1, 2.5));
}

TEST_F(Insisting, EndsWithSomebodyElsesOrder) {
  ASSERT_TRUE(gets_starts(1));
  gate_.other_order = 7;
  gets_starts(1000, 0.5);  // what was under way
  const int starts = gate_.starts;
  EXPECT_FALSE(gets_starts(starts + 1, 2.5));
}

}  // namespace
}  // namespace foretrack::testing
