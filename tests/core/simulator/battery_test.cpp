// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/battery.hpp"

#include <gtest/gtest.h>

#include "core/simulator/simulate.hpp"

namespace foretrack {
namespace {

TEST(Battery, HoversForItsCapacityOverItsCurrent) {
  Battery battery;
  double hovered_s = 0.0;
  for (; battery.state().remaining > 0.0; hovered_s += 0.1) drain(battery, 0.0, 0.0, true, 0.1);
  const BatteryParams& p = battery.params;
  EXPECT_NEAR(hovered_s, 3600.0 * p.capacity_ah / (p.hover_current_a + p.standing_current_a), 0.2);
  EXPECT_NEAR(battery.state().time_remaining_s, 0.0, 0.1);
}

TEST(Battery, WarnsWhereThePx4Does) {
  Battery battery;
  const auto at = [&](double remaining) {
    battery.used_ah = (1.0 - remaining) * battery.params.capacity_ah;
    return battery.state().warning;
  };
  EXPECT_EQ(at(0.16), BatteryWarning::kNone);
  EXPECT_EQ(at(0.14), BatteryWarning::kLow);
  EXPECT_EQ(at(0.06), BatteryWarning::kCritical);
  EXPECT_EQ(at(0.04), BatteryWarning::kEmergency);
}

TEST(Battery, ClimbingCostsMoreThanHoveringAndStandingAlmostNothing) {
  Battery hover, climb, bank, stand;
  drain(hover, 0.0, 0.0, true, 1.0);
  drain(climb, 3.0, 0.0, true, 1.0);
  drain(bank, 0.0, 5.0, true, 1.0);
  drain(stand, 0.0, 0.0, false, 1.0);
  EXPECT_GT(climb.used_ah, 1.2 * hover.used_ah);
  EXPECT_GT(bank.used_ah, 1.1 * hover.used_ah);
  EXPECT_LT(stand.used_ah, 0.1 * hover.used_ah);
  EXPECT_LT(climb.state().voltage_v, hover.state().voltage_v);
  EXPECT_LT(hover.state().voltage_v, stand.state().voltage_v);
}

TEST(Battery, OfASimulatedVehicleEmpties) {
  Scenario scenario;
  scenario.world.min_m = {-10, -10, 0};
  scenario.world.max_m = {10, 10, 4};
  scenario.target.route_m = {{0, 0}, {8, 0}};
  scenario.vehicle_enu_m = Vec3(-2.0, 0.0, 1.5);
  SimulatorState state = make_simulator(scenario);
  for (int i = 0; i < 1000; ++i) simulate(state, {}, 0.01);
  const Battery& battery = state.output.battery;
  const double hovering_ah = 10.0 / 3600.0 * battery.params.hover_current_a;
  EXPECT_NEAR(battery.used_ah, hovering_ah, 0.2 * hovering_ah);
  EXPECT_FALSE(state.output.offboard_possible);  // without a heartbeat
}

}  // namespace
}  // namespace foretrack
