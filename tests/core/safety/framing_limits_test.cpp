// SPDX-License-Identifier: Apache-2.0
#include "core/safety/framing_limits.hpp"

#include <gtest/gtest.h>

#include "core/common/geometry.hpp"

namespace foretrack {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr FramingLimits kLimits{.distance_min_m = 1.5,
                                .distance_max_m = 10.0,
                                .height_min_m = -0.5,
                                .height_max_m = 5.0,
                                .circling_max_rad_s = 0.5};

TEST(FramingLimits, WhatIsFreeIsSafe) {
  EXPECT_TRUE(is_safe({}, kLimits));
}

TEST(FramingLimits, TheirEndsAreSafe) {
  EXPECT_TRUE(is_safe({1.5, -0.5, -kPi, -0.5}, kLimits));
  EXPECT_TRUE(is_safe({10.0, 5.0, kPi, 0.5}, kLimits));
}

TEST(FramingLimits, EachValueBeyondThemIsNot) {
  for (const double distance_m : {1.4, 10.1, -2.0, kInfinity})
    EXPECT_FALSE(is_safe({.distance_m = distance_m}, kLimits)) << distance_m;
  for (const double height_m : {-0.6, 5.1, kInfinity})
    EXPECT_FALSE(is_safe({.height_m = height_m}, kLimits)) << height_m;
  for (const double bearing_rad : {-3.2, 3.2, kInfinity})
    EXPECT_FALSE(is_safe({.bearing_rad = bearing_rad}, kLimits)) << bearing_rad;
  for (const double circling_rad_s : {-0.6, 0.6, Framing::kFree})
    EXPECT_FALSE(is_safe({.circling_rad_s = circling_rad_s}, kLimits)) << circling_rad_s;
}

}  // namespace
}  // namespace foretrack
