// SPDX-License-Identifier: Apache-2.0
#include "services/convert/px4_home.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace foretrack {
namespace {

namespace msg = px4_msgs::msg;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr GlobalPlace kBerlin{52.5, 13.4, 35.0};

TEST(GlobalPlace, ADegreeNorthwardsIsThatOfASphere) {
  const GlobalPlace place = global_of(kBerlin, {0.0, 1000.0, 5.0});
  EXPECT_NEAR(place.lat_deg - kBerlin.lat_deg, 1000.0 / 111194.93, 1e-9);
  EXPECT_NEAR(place.lon_deg, kBerlin.lon_deg, 1e-12);
  EXPECT_EQ(place.alt_m, 40.0);
  const GlobalPlace east = global_of(kBerlin, {100.0, 0.0, 0.0});
  EXPECT_NEAR(east.lon_deg - kBerlin.lon_deg, 100.0 / (111194.93 * std::cos(0.9162978573)), 1e-8);
}

TEST(GlobalPlace, LeadsBackToWhereItCameFrom) {
  for (const GlobalPlace& origin :
       {kBerlin, GlobalPlace{-33.9, 179.999, 0.0}, GlobalPlace{0.0, 0.0, 0.0}})
    for (const Vec3& place : {Vec3(0, 0, 0), Vec3(300, -40, 3), Vec3(-5000, 7000, -20)}) {
      EXPECT_LT((local_of(origin, global_of(origin, place)) - place).norm(), 1e-2)
          << place.transpose();
    }
}

TEST(LocalPosition, HasAnOriginWhereItKnowsAGlobalPosition) {
  msg::VehicleLocalPosition m;
  EXPECT_FALSE(origin_of(m));
  set_origin(kBerlin, m);
  ASSERT_TRUE(origin_of(m));
  EXPECT_EQ(origin_of(m)->lat_deg, kBerlin.lat_deg);
  m.ref_lon(kNaN);
  EXPECT_FALSE(origin_of(m));
  m.ref_lon(181.0);
  EXPECT_FALSE(origin_of(m));
}

TEST(HomePosition, IsInTheWorldFrame) {
  msg::HomePosition m;
  to_idl(kBerlin, {3.0, -4.0, 1.0}, 2.0, m);
  EXPECT_EQ(m.x(), -4.0f);
  EXPECT_EQ(m.z(), -1.0f);
  const auto home = from_idl(m);
  ASSERT_TRUE(home) << home.fault().text;
  EXPECT_EQ(*home, Vec3(3.0, -4.0, 1.0));
  m.x(std::numeric_limits<float>::infinity());
  EXPECT_FALSE(from_idl(m));
  m.x(1.0f);
  m.valid_lpos(false);
  EXPECT_EQ(from_idl(m).fault().field, "valid_lpos");
}

TEST(SetHome, NamesAPlaceAndNotWhereTheVehicleIs) {
  msg::VehicleCommand m;
  to_set_home(kBerlin, 3, 1.0, m);
  EXPECT_EQ(m.command(), 179u);
  EXPECT_EQ(m.target_system(), 3);
  EXPECT_EQ(m.param1(), 0.0f);
  const auto asked = home_asked_by(m);
  ASSERT_TRUE(asked);
  EXPECT_EQ(asked->lat_deg, kBerlin.lat_deg);
  EXPECT_EQ(asked->alt_m, kBerlin.alt_m);
  m.param6(kNaN);
  EXPECT_FALSE(home_asked_by(m));
  m.param6(13.0);
  m.param1(1.0f);
  EXPECT_FALSE(home_asked_by(m));
  m.command(400);
  EXPECT_FALSE(home_asked_by(m));
}

}  // namespace
}  // namespace foretrack
