// SPDX-License-Identifier: Apache-2.0
#include "core/common/framing.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

TEST(Framing, IsTheSameIfTheSameIsFree) {
  EXPECT_EQ(Framing{}, Framing{});
  EXPECT_EQ((Framing{.distance_m = 2.0}), (Framing{.distance_m = 2.0}));
  for (const Framing& other : {Framing{.distance_m = 2.0}, Framing{.height_m = 2.0},
                               Framing{.bearing_rad = 2.0}, Framing{.circling_rad_s = 0.2}}) {
    EXPECT_NE(other, Framing{});
    EXPECT_FALSE(other.is_free());
  }
  EXPECT_TRUE(Framing{}.is_free());
}

}  // namespace
}  // namespace foretrack
