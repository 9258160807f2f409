// SPDX-License-Identifier: Apache-2.0
#include "services/operator/fleet_log.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "services/common/raw.hpp"
#include "services/convert/fleet.hpp"
#include "services/convert/vehicle.hpp"
#include "tests/services/common/bus.hpp"

namespace foretrack::testing {
namespace {

FleetMember member(int pieces, int persons, int intentions) {
  FleetMember m;
  m.vehicle = "uav1";
  m.frame = "map";
  m.plan.count = pieces;
  for (int i = 0; i < pieces; ++i) m.plan.pieces[i].duration_s = 0.5;
  m.person_count = persons;
  m.intention_count = intentions;
  return m;
}

TEST(BytesOf, AreThoseOfTheMessageOnTheWire) {
  for (const FleetMember& m : {member(0, 0, 0), member(6, 1, 5), member(16, 4, 5)}) {
    foretrack_msgs::msg::FleetMember message;
    to_idl(m, message);
    const auto on_wire =
        static_cast<double>(to_cdr(type_ops<foretrack_msgs::msg::FleetMember>(), &message).size());
    EXPECT_NEAR(bytes_of(m), on_wire, 0.05 * on_wire);
  }
}

// Vehicles of a scenario as a simulator tells of them.
class FleetLogOnDds : public ::testing::Test {
 protected:
  struct Told {
    explicit Told(const NodeOptions& options) : node(options), vehicle(node), target(node) {}
    Node node;
    Writer<topics::VehicleTruth> vehicle;
    Writer<topics::TargetTruth> target;
  };
  static Scenario scenario() {
    Scenario s;
    s.world.min_m = {-10, -10, 0};
    s.world.max_m = {10, 10, 5};
    s.vehicles.resize(2);
    s.vehicles[0].name = "uav1";
    s.vehicles[1].name = "uav2";
    return s;
  }
  static NodeOptions named(const char* vehicle) {
    NodeOptions options = node_options("simulator");
    options.names.vehicle = vehicle;
    return options;
  }
  void tell(Told& told, double stamp_s, const Vec3& place) {
    to_idl(VehicleState{.stamp_s = stamp_s, .position_enu_m = place}, told.vehicle.sample());
    told.vehicle.write();
    to_idl(VehicleState{.stamp_s = stamp_s, .position_enu_m = {2, 0, 1}}, told.target.sample());
    told.target.write();
  }

  FleetLog log_{node_options("demo"), scenario()};
  Told one_{named("uav1")}, two_{named("uav2")};
};

TEST_F(FleetLogOnDds, PutsVehiclesOfOneTimeIntoARow) {
  double stamp_s = 100.0;
  ASSERT_TRUE(eventually([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    stamp_s += 0.02;
    tell(one_, stamp_s, {0, 0, 1.5});
    tell(two_, stamp_s, {0, 2, 1.5});
    log_.update();
    return std::count_if(log_.rows().begin(), log_.rows().end(), [](const FleetRow& row) {
             return row.members[0].there && row.members[1].there;
           }) >= 3;
  }));
  const FleetRow& row = log_.rows().back();
  EXPECT_EQ(row.members[0].position_enu_m, Vec3(0, 0, 1.5));
  EXPECT_EQ(row.members[1].position_enu_m, Vec3(0, 2, 1.5));
  EXPECT_EQ(row.person_enu_m, Vec3(2, 0, 1));
  EXPECT_FALSE(row.members[0].sees) << "no gate was heard: nobody is on board";
  EXPECT_NEAR(log_.flight({}, {}).metrics.min_separation_m, 1.5, 1e-9);
}

TEST_F(FleetLogOnDds, WhoIsSilentIsNotThere) {
  double stamp_s = 100.0;
  ASSERT_TRUE(eventually([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    stamp_s += 0.02;
    tell(one_, stamp_s, {0, 0, 1.5});
    log_.update();
    return !log_.rows().empty() && log_.rows().back().members[0].there;
  }));
  EXPECT_FALSE(log_.rows().back().members[1].there);
}

}  // namespace
}  // namespace foretrack::testing
