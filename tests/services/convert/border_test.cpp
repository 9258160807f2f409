// SPDX-License-Identifier: Apache-2.0
// Any bytes on any topic, as they come in: through the CDR wrapper, the checks, and a use.
#include <gtest/gtest.h>

#include "services/common/raw.hpp"
#include "services/convert/bodies.hpp"
#include "services/convert/fleet.hpp"
#include "services/convert/fleet_report.hpp"
#include "services/convert/image.hpp"
#include "services/convert/map.hpp"
#include "services/convert/prediction.hpp"
#include "services/convert/px4.hpp"
#include "services/convert/px4_command.hpp"
#include "services/convert/px4_health.hpp"
#include "services/convert/px4_home.hpp"
#include "services/convert/safety.hpp"
#include "services/convert/target.hpp"
#include "services/convert/trajectory.hpp"
#include "services/convert/vehicle.hpp"
#include "tests/fuzz/mutate.hpp"

extern "C" int fuzz_border(const std::uint8_t* data, std::size_t size);

namespace foretrack {
namespace {

using Seed = std::vector<std::uint8_t>;

// In the order of the fuzz target's types.
template <class Message>
void add(std::vector<Seed>& seeds, const Message& message) {
  const CdrBytes bytes = to_cdr(type_ops<Message>(), &message);
  Seed seed{static_cast<std::uint8_t>(seeds.size())};
  seed.insert(seed.end(), bytes.begin(), bytes.end());
  seeds.push_back(seed);
}

PlannedTrajectory a_plan() {
  PlannedTrajectory plan;
  plan.id = 1;
  plan.stamp_s = plan.start_s = 10.0;
  plan.pieces.resize(2);
  for (auto& piece : plan.pieces) piece.duration_s = 0.5;
  plan.pieces[1].coefficients.row(0) = plan.pieces[0].position(0.5).transpose();
  plan.tail_start_s = 0.5;
  plan.yaw.nodes.resize(1);  // one node, and a time before its start, read beyond the heap
  plan.status = PlanStatus::kFresh;
  return plan;
}

template <class Message, class... Values>
Message message_of(const Values&... values) {
  Message message;
  to_idl(values..., message);
  return message;
}

std::vector<Seed> good_samples() {
  using namespace foretrack_msgs::msg;
  std::vector<Seed> seeds;
  foretrack::MovingBodies bodies;
  bodies.count = 2;
  foretrack_msgs::msg::MovingBodies told;
  to_idl(bodies, {}, told);
  add(seeds, told);
  add(seeds, message_of<foretrack_msgs::msg::BodySightings>(foretrack::BodySightings{}));
  add(seeds, message_of<sensor_msgs::msg::CameraInfo>(CameraModel{}, 1.0));
  add(seeds, foretrack_msgs::msg::LocalMap());
  add(seeds, message_of<TargetIntention>(IntentionAssessment{}));
  add(seeds, message_of<TargetPrediction>(Prediction{}));
  add(seeds, message_of<px4_msgs::msg::TrajectorySetpoint>(Setpoint{}));
  add(seeds, message_of<px4_msgs::msg::VehicleOdometry>(VehicleState{}));
  add(seeds, message_of<px4_msgs::msg::VehicleStatus>(AutopilotStatus{}));
  add(seeds, message_of<px4_msgs::msg::VehicleCommand>(AutopilotCommand{}, 1.0));
  add(seeds, message_of<px4_msgs::msg::BatteryStatus>(BatteryState{}, 1.0));
  add(seeds, message_of<px4_msgs::msg::HomePosition>(GlobalPlace{}, Vec3::Zero().eval(), 1.0));
  add(seeds, message_of<foretrack_msgs::msg::MissionCommand>(foretrack::MissionCommand{}));
  add(seeds, message_of<foretrack_msgs::msg::SafetyState>(GateReport{}));
  add(seeds, message_of<foretrack_msgs::msg::TargetObservation>(foretrack::TargetObservation{}));
  add(seeds, message_of<foretrack_msgs::msg::TargetState>(foretrack::TargetState{}));
  add(seeds, message_of<foretrack_msgs::msg::PlannedTrajectory>(a_plan()));
  add(seeds, message_of<nav_msgs::msg::Odometry>(VehicleState{}));
  foretrack::FleetMember member;
  member.vehicle = "uav2";
  member.frame = "map";
  member.plan.count = member.person_count = 1;
  member.plan.pieces[0].duration_s = 0.5;
  member.persons[0].id = member.follows = 1;
  member.intention_count = 5;
  add(seeds, message_of<foretrack_msgs::msg::FleetMember>(member));
  FleetReport fleet;
  fleet.vehicle = fleet.division.parts[0].vehicle = fleet.peers[0].vehicle = "uav2";
  fleet.division.count = fleet.peer_count = 1;
  add(seeds, message_of<foretrack_msgs::msg::FleetDivision>(fleet));
  return seeds;
}

TEST(Border, NoBytesOnAnyTopicLeadOutsideOrCrash) {
  const auto seeds = good_samples();
  testing::Mutator mutator(5);
  for (const Seed& seed : seeds) {
    fuzz_border(seed.data(), seed.size());
    const Seed good(seed.begin() + 1, seed.end());
    for (int k = 0; k < 4000; ++k) {
      Seed bad = mutator.mutate(good);
      bad.insert(bad.begin(), seed[0]);
      fuzz_border(bad.data(), bad.size());
    }
  }
}

TEST(Border, APlanOfOneYawNodeIsAcceptedAndReadAtAnyTime) {
  const auto plan = from_idl(message_of<foretrack_msgs::msg::PlannedTrajectory>(a_plan()));
  ASSERT_TRUE(plan) << plan.fault().text;
  EXPECT_EQ(plan->yaw.at(-1.0).angle_rad, 0.0);
}

}  // namespace
}  // namespace foretrack
