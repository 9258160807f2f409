// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/fleet/fleet_service.hpp"

#include "services/convert/bodies.hpp"
#include "services/convert/fleet.hpp"
#include "services/convert/fleet_report.hpp"
#include "services/convert/map.hpp"
#include "services/convert/safety.hpp"
#include "services/convert/target.hpp"
#include "tests/services/onboard/neighbours.hpp"

namespace foretrack::testing {
namespace {

// A vehicle at the origin, and one of another name that tells the same fleet.
class FleetOnDds : public ::testing::Test {
 protected:
  FleetOnDds() { neighbours_.vehicle.position_enu_m = {0.0, 0.0, 1.5}; }

  FleetMember other(const char* name) {
    const double now_s = neighbours_.now_s();
    FleetMember m;
    m.vehicle = name;
    m.frame = "map";
    m.stamp_s = now_s;
    m.sequence_number = ++told_;
    m.flies = true;
    m.position_enu_m = {4.5, 0.5, 1.5};
    m.follows = m.person_count = 1;
    m.persons[0].id = 1;
    m.persons[0].status = TrackStatus::kTracking;
    m.persons[0].in_sight = true;
    m.persons[0].position_enu_m = {2.0, 0.0, 1.0};
    m.persons[0].covariance = 0.01 * Mat6::Identity();
    return m;
  }
  void tell(const FleetMember& member) {
    to_idl(member, member_.sample());
    member_.write();
  }
  void feed() {
    neighbours_.send_odometry();
    if (!sees_) return;
    to_idl(walking_target(neighbours_.now_s()), target_.sample());
    target_.write();
  }
  void feed_with(const char* name) {
    feed();
    tell(other(name));
  }
  void listen() {
    own_reader_.take_each_as(convert_member, [this](const FleetMember& m) {
      if (m.vehicle.view() == "uav1" && m.frame.view() == "map") own_ = m;
    });
    division_reader_.take_each_as(
        [](const foretrack_msgs::msg::FleetDivision& m) { return from_idl(m); },
        [this](const FleetReport& r) { division_ = r; });
    bodies_reader_.take_each_as(
        [](const foretrack_msgs::msg::MovingBodies& m) { return from_idl(m); },
        [this](const MovingBodies& b) { bodies_ = b; });
    fused_reader_.take_each_as(
        [](const foretrack_msgs::msg::TargetState& m) { return from_idl(m); },
        [this](const TargetState& t) { fused_ = t; });
  }
  static Converted<FleetMember> convert_member(const foretrack_msgs::msg::FleetMember& m) {
    return from_idl(m);
  }

  Neighbours neighbours_;
  Writer<topics::FleetMember> member_{neighbours_.node()};
  Writer<topics::TargetState> target_{neighbours_.node()};
  Reader<topics::FleetMember> own_reader_{neighbours_.node()};
  Reader<topics::FleetDivision> division_reader_{neighbours_.node()};
  Reader<topics::FleetBodies> bodies_reader_{neighbours_.node()};
  Reader<topics::FleetTarget> fused_reader_{neighbours_.node()};
  Running service_{[](const ServiceOptions& options, Stop& stop) {
    run_fleet(options, FleetParams{}, PlanningParams{}, stop);
  }};
  std::uint32_t told_ = 0;
  bool sees_ = true;
  std::optional<FleetMember> own_;
  std::optional<FleetReport> division_;
  std::optional<MovingBodies> bodies_;
  std::optional<TargetState> fused_;
};

TEST_F(FleetOnDds, AloneItTellsWhereItIsAndNothingElse) {
  ASSERT_TRUE(neighbours_.until(
      [&] {
        listen();
        return own_ && own_->sequence_number > 10 && own_->person_count == 1;
      },
      [&] { feed(); }));
  EXPECT_EQ(own_->position_enu_m, neighbours_.vehicle.position_enu_m);
  EXPECT_LT((own_->followed()->position_enu_m - Vec3(2.0, 0.0, 1.0)).head<2>().norm(), 0.5);
  EXPECT_FALSE(division_);
  EXPECT_FALSE(bodies_);
  EXPECT_FALSE(fused_);
}

TEST_F(FleetOnDds, WithoutOdometryItTellsNothing) {
  const double begin_s = neighbours_.now_s();
  ASSERT_TRUE(neighbours_.until([&] { return listen(), neighbours_.now_s() > begin_s + 2.0; },
                                [&] { tell(other("uav2")); }));
  EXPECT_FALSE(own_);
}

TEST_F(FleetOnDds, TwoDivideTheSeatsAndKeepClearOfEachOther) {
  ASSERT_TRUE(neighbours_.until(
      [&] {
        listen();
        return division_ && division_->division.count == 2 && bodies_ && bodies_->count == 1;
      },
      [&] { feed_with("uav2"); }));
  EXPECT_FALSE(division_->place.is_alone);
  ASSERT_EQ(division_->peer_count, 1);
  EXPECT_EQ(division_->peers[0].vehicle.view(), "uav2");
  EXPECT_EQ(division_->peers[0].trust, FleetTrust::kCommon);
  EXPECT_EQ(bodies_->bodies[0].kind, BodyKind::kVehicle);
  EXPECT_LT((bodies_->bodies[0].position_enu_m - Vec3(4.5, 0.5, 0.0)).head<2>().norm(), 0.1);
  EXPECT_NEAR(division_->separation_m, Vec3(4.5, 0.5, 0.0).norm() - 0.5, 0.1);
  EXPECT_FALSE(fused_) << "it sees them by itself";
}

TEST_F(FleetOnDds, WhoDoesNotSeeThePersonIsToldWhereTheOthersDo) {
  sees_ = false;
  ASSERT_TRUE(
      neighbours_.until([&] { return listen(), fused_.has_value(); }, [&] { feed_with("uav2"); }));
  EXPECT_EQ(fused_->status, TrackStatus::kTracking);
  EXPECT_LT((fused_->position_enu_m - Vec3(2.0, 0.0, 1.0)).norm(), 0.1);
}

TEST_F(FleetOnDds, AnotherVehicleWithItsNameIsAnAlarmAndNoPeer) {
  ASSERT_TRUE(neighbours_.until(
      [&] {
        return neighbours_.refused("rt/fleet/member", "of another vehicle with this one's name") >
               0;
      },
      [&] { feed_with("uav1"); }));
  listen();
  EXPECT_FALSE(division_) << "nobody else was heard";
}

TEST_F(FleetOnDds, RefusesGarbageAndGoesOn) {
  ASSERT_TRUE(neighbours_.until([&] { return listen(), division_.has_value(); },
                                [&] {
                                  FleetMember bad = other("uav2");
                                  bad.radius_m = -1.0;
                                  tell(bad);
                                  feed_with("uav2");
                                }));
  EXPECT_TRUE(neighbours_.until([&] { return neighbours_.refused("rt/fleet/member") > 0; }));
}

}  // namespace
}  // namespace foretrack::testing
