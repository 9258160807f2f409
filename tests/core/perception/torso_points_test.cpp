// SPDX-License-Identifier: Apache-2.0
#include "core/perception/torso_points.hpp"

#include <gtest/gtest.h>

#include "tests/core/perception/torso_pose.hpp"

namespace foretrack {
namespace {

TEST(VisitTorso, VisitsTheMiddlesOfEqualPartsRowByRow) {
  const PersonPose pose = testing::pose_at({50.0, 80.0}, 100.0);  // 40…60 across, 70…90 down
  std::vector<Vec2> points;
  std::vector<int> rows;
  visit_torso(pose.landmarks, 4, 0.1, [&](const Vec2& px, int row) {
    points.push_back(px);
    rows.push_back(row);
  });
  ASSERT_EQ(points.size(), 16U);
  for (std::size_t k = 0; k < 16; ++k) {
    EXPECT_EQ(rows[k], static_cast<int>(k / 4));
    // A tenth is left out at each side; the other eight tenths have four parts.
    EXPECT_NEAR(points[k].y(), 70.0 + 20.0 * (0.1 + 0.2 * (static_cast<double>(k / 4) + 0.5)),
                1e-9);
    EXPECT_NEAR(points[k].x(), 60.0 - 20.0 * (0.1 + 0.2 * (static_cast<double>(k % 4) + 0.5)),
                1e-9);
  }
}

TEST(VisitTorso, FollowsATorsoThatLeansAndNarrows) {
  PersonPose pose = testing::pose_at({50.0, 80.0}, 100.0);
  pose.landmarks[kLeftHip].image_px += Vec2(10.0, 0.0);
  pose.landmarks[kRightHip].image_px += Vec2(20.0, 0.0);  // 60…70 at the hips
  visit_torso(pose.landmarks, 9, 0.0, [&](const Vec2& px, int) {
    const double down = (px.y() - 70.0) / 20.0;
    EXPECT_GT(px.x(), 40.0 + 20.0 * down);
    EXPECT_LT(px.x(), 60.0 + 10.0 * down);
  });
}

}  // namespace
}  // namespace foretrack
