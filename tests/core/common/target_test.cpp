// SPDX-License-Identifier: Apache-2.0
#include "core/common/target.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

TEST(TargetState, IsUsableWhileItIsTrackedOrCoasts) {
  TargetState target;
  EXPECT_FALSE(target.usable()) << "before anything was seen";
  for (const auto& [status, usable] :
       {std::pair{TrackStatus::kNone, false}, std::pair{TrackStatus::kTracking, true},
        std::pair{TrackStatus::kCoasting, true}, std::pair{TrackStatus::kLost, false}}) {
    target.status = status;
    EXPECT_EQ(target.usable(), usable);
  }
}

TEST(TargetState, SpeedIsThatOverTheGround) {
  TargetState target;
  target.velocity_enu_m_s = {3.0, -4.0, 2.0};
  EXPECT_DOUBLE_EQ(target.speed_m_s(), 5.0);
}

}  // namespace
}  // namespace foretrack
