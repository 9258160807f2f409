// SPDX-License-Identifier: Apache-2.0
#include "services/convert/px4_health.hpp"

#include <gmock/gmock.h>

namespace foretrack {
namespace {

namespace msg = px4_msgs::msg;
using ::testing::HasSubstr;

TEST(BatteryStatus, SaysWhatTheBatteryIs) {
  const BatteryState battery{.cells = 4,
                             .capacity_ah = 5.0,
                             .used_ah = 4.5,
                             .remaining = 0.1,
                             .voltage_v = 14.0,
                             .current_a = 10.0,
                             .time_remaining_s = 180.0,
                             .warning = BatteryWarning::kLow};
  msg::BatteryStatus m;
  to_idl(battery, 2.5, m);
  EXPECT_EQ(m.timestamp(), 2'500'000u);
  EXPECT_NEAR(m.remaining(), 0.1, 1e-6);
  EXPECT_NEAR(m.voltage_v(), battery.voltage_v, 1e-5);
  EXPECT_NEAR(m.time_remaining_s(), 180.0, 1e-3);
  EXPECT_EQ(m.warning(), msg::BatteryStatus_Constants::WARNING_LOW);
  EXPECT_EQ(m.cell_count(), 4);
  EXPECT_NEAR(m.voltage_cell_v()[3], battery.voltage_v / 4, 1e-5);
  EXPECT_EQ(m.voltage_cell_v()[4], 0.0f);
}

TEST(FailsafeFlags, NameWhatOffboardNeedsAndOnlyThat) {
  msg::FailsafeFlags flags;
  to_flags(1.0, true, BatteryWarning::kNone, false, flags);
  EXPECT_EQ(what_hinders_offboard(flags), "") << "offboard needs neither a mission nor GNSS";
  to_flags(1.0, false, BatteryWarning::kNone, false, flags);
  EXPECT_EQ(what_hinders_offboard(flags), "no offboard signal");
  flags.local_position_invalid(true);
  flags.home_position_invalid(true);  // needed to return only
  EXPECT_EQ(what_hinders_offboard(flags), "no offboard signal, no local position");
  to_flags(1.0, true, BatteryWarning::kCritical, false, flags);
  EXPECT_THAT(what_hinders_offboard(flags), HasSubstr("battery is critical"));
}

TEST(FailsafeFlags, TellOurOwnSilenceFromWhatGuardsTheVehicle) {
  px4_msgs::msg::FailsafeFlags flags;
  to_flags(1.0, true, BatteryWarning::kNone, false, flags);
  EXPECT_FALSE(is_of_our_making(flags));
  to_flags(1.0, false, BatteryWarning::kNone, false, flags);
  EXPECT_TRUE(is_of_our_making(flags));
  to_flags(1.0, false, BatteryWarning::kNone, true, flags);
  EXPECT_FALSE(is_of_our_making(flags));
  to_flags(1.0, false, BatteryWarning::kCritical, false, flags);
  EXPECT_FALSE(is_of_our_making(flags));
  to_flags(1.0, true, BatteryWarning::kNone, false, flags);
  EXPECT_TRUE(is_of_our_making(flags, true)) << "the signal is back, the failsafe still acts";
  to_flags(1.0, true, BatteryWarning::kNone, true, flags);
  EXPECT_FALSE(is_of_our_making(flags, true));
}

TEST(BatteryStatus, RoundTripsAndMustBeConnected) {
  BatteryState in;
  in.cells = 4;
  in.capacity_ah = 5.0;
  in.remaining = 0.25;
  in.voltage_v = 14.5;
  in.warning = BatteryWarning::kLow;
  px4_msgs::msg::BatteryStatus m;
  to_idl(in, 1.0, m);
  const auto out = from_idl(m);
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_NEAR(out->remaining, 0.25, 1e-6);
  EXPECT_EQ(out->warning, BatteryWarning::kLow);
  m.remaining(-1.0f);  // PX4's word for unknown
  EXPECT_FALSE(from_idl(m));
  to_idl(in, 1.0, m);
  m.connected(false);
  EXPECT_FALSE(from_idl(m));
}

}  // namespace
}  // namespace foretrack
