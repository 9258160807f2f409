// SPDX-License-Identifier: Apache-2.0
// Orders to a gate that hears the station, and to one that has forgotten it.
#include "services/ground_station/control/commander.hpp"

#include "core/safety/mission.hpp"
#include "foretrack_msgs/msg/MissionCommand.h"
#include "foretrack_msgs/msg/SafetyState.h"
#include "services/common/clock.hpp"
#include "services/common/reader.hpp"
#include "services/common/topics.hpp"
#include "services/convert/order_proof.hpp"
#include "services/ground_station/bus/channel.hpp"
#include "tests/services/common/bus.hpp"

namespace foretrack::station {
namespace {

using testing::eventually;
using testing::node_options;

/// Speaks all the time, and answers unless it is deaf.
class Gate {
 public:
  bool deaf = false;
  bool writing = false;  // a slow disk: what was taken is not yet confirmed
  int orders = 0;        // that came, also to deaf ears
  double latest_stamp_s = 0.0;
  Mission mission{.phase = MissionPhase::kTracking, .engaged = true};

  CdrBytes step(double now_s) {
    orders_.take_each([&](const foretrack_msgs::msg::MissionCommand& m) {
      ++orders;
      latest_stamp_s = std::max(latest_stamp_s, to_seconds(m.header().stamp()));
      if (deaf) return;
      const MissionCommand command{m.id(),
                                   now_s,
                                   static_cast<MissionOrder>(m.command()),
                                   m.operator_id().c_str(),
                                   m.lease_id().c_str(),
                                   is_proved("uav1", m)};
      result_ = apply(command, mission, {now_s, now_s}, {});
      state_.command_id(m.id());
      state_.command(m.command());
    });
    const bool pending = writing && result_ == MissionResult::kAccepted;
    state_.command_result(static_cast<std::uint8_t>(pending ? MissionResult::kPending : result_));
    state_.phase(static_cast<std::uint8_t>(mission.phase));
    return to_cdr(type_ops<foretrack_msgs::msg::SafetyState>(), &state_);
  }

 private:
  Node node_{node_options("gate")};
  Reader<topics::MissionCommand> orders_{node_};
  foretrack_msgs::msg::SafetyState state_;
  MissionResult result_ = MissionResult::kNone;
};

class Orders : public ::testing::Test {
 protected:
  Orders() {
    commander_.on_unanswered = [this](const std::string& why) { complaints_.push_back(why); };
    EXPECT_TRUE(until([&] { return asked("take"); }));
  }
  void step() {
    commander_.hear("uav1", gate_.step(now_s()), now_s());
    commander_.tick(now_s());
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  bool until(const std::function<bool()>& condition) {
    return eventually([&] {
      step();
      return condition();
    });
  }
  /// Once it was answered, with yes.
  bool asked(const std::string& what) {
    if (asked_ != what) {
      asked_ = what;
      outcome_.reset();
      const auto report = [this](const Outcome& outcome) { outcome_ = outcome; };
      if (what == "take")
        commander_.take("uav1", "ada", now_s(), report);
      else
        commander_.command("uav1",
                           {.order = what == "stop" ? MissionOrder::kStop : MissionOrder::kHold,
                            .operator_name = "ada"},
                           now_s(), report);
    }
    if (outcome_ && !outcome_->ok && what == "take") asked_.clear();  // before it was discovered
    return outcome_ && outcome_->ok;
  }
  std::optional<Unconfirmed> unconfirmed() {
    return commander_.missions(now_s())["uav1"].unconfirmed;
  }
  double now_s() const { return steady_s() + skipped_s_; }

  Gate gate_;
  Commander commander_{std::make_shared<Node>(node_options("station")), true,
                       [](const std::string&) {}};
  std::vector<std::string> complaints_;
  std::optional<Outcome> outcome_;
  std::string asked_;
  double skipped_s_ = 0.0;
};

TEST_F(Orders, OneThatIsAnsweredIsNeitherSentAgainNorCalledUnconfirmed) {
  gate_.orders = 0;
  EXPECT_TRUE(until([&] { return asked("hold"); }));
  EXPECT_EQ(gate_.mission.phase, MissionPhase::kHolding);
  skipped_s_ += 0.9;
  EXPECT_TRUE(until([&] { return gate_.orders > 1; })) << "the lease is renewed";
  EXPECT_FALSE(unconfirmed());
  EXPECT_TRUE(complaints_.empty());
}

TEST_F(Orders, AreNotOfTheFutureWhereTheVehiclesSimulatedClockStands) {
  gate_.deaf = true;
  asked("stop");
  EXPECT_TRUE(until([&] { return gate_.orders > 0; }));
  const int before = gate_.orders;
  skipped_s_ += 3.0;  // in which nothing was heard of it
  commander_.tick(now_s());
  EXPECT_TRUE(until([&] { return gate_.orders > before; }));
  EXPECT_LT(gate_.latest_stamp_s, 0.5);
}

TEST_F(Orders, OneThatIsBeingWrittenDownIsNotSentAgain) {
  gate_.writing = true;
  asked("hold");
  EXPECT_TRUE(until([&] { return gate_.mission.phase == MissionPhase::kHolding; }));
  const int orders = gate_.orders;
  step();
  skipped_s_ += 1.5;
  for (int i = 0; i < 50; ++i) step();
  EXPECT_EQ(gate_.orders, orders) << "a second one would be refused, as the first acts already";
  EXPECT_FALSE(outcome_);
  gate_.writing = false;
  EXPECT_TRUE(until([&] { return asked("hold"); }));
}

TEST_F(Orders, OneThatIsLostIsUnconfirmedAndArrivesWhenTheBusWasJoinedAnew) {
  gate_.deaf = true;  // as if it had forgotten the station's participant
  asked("hold");
  EXPECT_TRUE(until([&] { return !complaints_.empty(); }));
  ASSERT_TRUE(unconfirmed());
  EXPECT_EQ(unconfirmed()->command, "hold");
  EXPECT_EQ(unconfirmed()->operator_name, "ada");
  EXPECT_TRUE(unconfirmed()->still_sent);
  EXPECT_FALSE(outcome_) << "it is tried again";
  commander_.move_to(std::make_shared<Node>(node_options("station")));
  gate_.deaf = false;
  EXPECT_TRUE(until([&] { return asked("hold"); }));
  EXPECT_EQ(gate_.mission.phase, MissionPhase::kHolding);
  EXPECT_EQ(complaints_.size(), 1u);
  EXPECT_FALSE(unconfirmed());
}

TEST_F(Orders, OneThatStaysUnansweredIsGivenUpAndRemainsUnconfirmed) {
  gate_.deaf = true;
  asked("hold");
  step();
  skipped_s_ += 5.0;
  EXPECT_TRUE(until([&] { return outcome_.has_value(); }));
  EXPECT_FALSE(outcome_->ok);
  EXPECT_FALSE(outcome_->answered);
  ASSERT_TRUE(unconfirmed());
  EXPECT_EQ(unconfirmed()->command, "hold");
  EXPECT_FALSE(unconfirmed()->still_sent);
  gate_.deaf = false;
  EXPECT_TRUE(until([&] { return !unconfirmed(); })) << "the lease's renewal is answered";
}

TEST_F(Orders, StopGoesOnByBothNodesAfterItWasReportedUnconfirmed) {
  gate_.deaf = true;
  asked("stop");
  step();
  commander_.move_to(std::make_shared<Node>(node_options("station")));
  gate_.orders = 0;
  EXPECT_TRUE(until([&] { return gate_.orders > 1; })) << "by the former node, at once";
  skipped_s_ += 5.0;
  EXPECT_TRUE(until([&] { return outcome_.has_value(); }));
  EXPECT_NE(outcome_->reason.find("STOP goes on"), std::string::npos) << outcome_->reason;
  EXPECT_FALSE(outcome_->answered);
  EXPECT_TRUE(unconfirmed()->still_sent);
  gate_.deaf = false;
  EXPECT_TRUE(until([&] { return gate_.mission.phase == MissionPhase::kStopped; }));
  EXPECT_TRUE(until([&] { return !unconfirmed(); }));
  step();
  gate_.orders = 0;
  for (int i = 0; i < 100; ++i) step();
  EXPECT_LE(gate_.orders, 1) << "it is sent no more; the lease may be renewed";
}

}  // namespace
}  // namespace foretrack::station
