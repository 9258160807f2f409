// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/body.hpp"

#include <gtest/gtest.h>

#include "core/simulator/person.hpp"

namespace foretrack {
namespace {

TEST(Body, TorsoJointsAverageToThePositionAndFaceTheYaw) {
  PersonState state;
  state.position_enu_m = {3, -2, 1.2};
  state.velocity_enu_m_s = {1, 0, 0};
  state.stride_rad = 1.0;
  for (const double yaw : {0.0, 1.0, kPi / 2.0, -2.5}) {
    state.body_yaw_rad = yaw;
    const auto joints = joints_enu_m(state, 1.75);
    const Vec3 mean = 0.25 * (joints[kLeftShoulder] + joints[kRightShoulder] + joints[kLeftHip] +
                              joints[kRightHip]);
    EXPECT_LT((mean - state.position_enu_m).norm(), 1e-9);
    // ξ_rb of the design: [y11 − y12, x12 − x11] points where the chest does.
    const Vec2 chest(joints[kLeftShoulder].y() - joints[kRightShoulder].y(),
                     joints[kRightShoulder].x() - joints[kLeftShoulder].x());
    EXPECT_NEAR(wrap_angle(yaw_of(chest) - yaw), 0.0, 1e-9);
  }
}

TEST(Body, FeetStandOnTheGroundAndTheHeadIsBelowTheHeight) {
  Person person = make_person({}, walk_along(std::vector<Vec2>{{0, 0}}, {}), 0.5);
  const auto joints = joints_enu_m(person.state, person.params.height_m);
  double lowest = 1e9, highest = -1e9;
  for (const Vec3& joint : joints) {
    lowest = std::min(lowest, joint.z());
    highest = std::max(highest, joint.z());
  }
  EXPECT_NEAR(lowest, 0.5, 0.05);
  EXPECT_NEAR(highest, 0.5 + 0.94 * 1.75, 0.03);
}

TEST(Body, LimbsKeepTheirLengthWhileWalking) {
  PersonState standing, walking;
  walking.velocity_enu_m_s = {1.5, 0, 0};
  walking.stride_rad = kPi / 2.0;
  const auto a = joints_enu_m(standing, 1.75), b = joints_enu_m(walking, 1.75);
  const std::pair<int, int> bones[] = {{23, 25}, {25, 27}, {27, 31}, {11, 13}, {13, 15}, {24, 26}};
  for (const auto& [i, k] : bones) EXPECT_NEAR((a[i] - a[k]).norm(), (b[i] - b[k]).norm(), 1e-9);
  EXPECT_GT((a[27] - b[27]).norm(), 0.2);
}

TEST(Body, ThePointsThatDecideSightAreOnTheBody) {
  PersonState state;
  state.position_enu_m = {3, -2, torso_height_m(1.8)};
  state.body_yaw_rad = 0.8;
  const auto points = body_points_enu_m(state, 1.8);
  const auto joints = joints_enu_m(state, 1.8);
  EXPECT_LT((points[1] - joints[kLeftShoulder]).norm(), 1e-9);
  EXPECT_LT((points[2] - joints[kRightShoulder]).norm(), 1e-9);
  EXPECT_LT((points[3] - 0.5 * (joints[kLeftHip] + joints[kRightHip])).norm(), 1e-9);
  EXPECT_LT((points[4] - 0.5 * (joints[25] + joints[26])).norm(), 0.02) << "knees";
  EXPECT_LT((points[0] - 0.5 * (joints[7] + joints[8])).norm(), 0.02) << "head, between the ears";
}

TEST(Body, BothSidesMirrorEachOther) {
  PersonState state;
  const auto joints = joints_enu_m(state, 1.7);
  for (const auto& [left, right] : {std::pair{11, 12}, {15, 16}, {23, 24}, {31, 32}, {7, 8}}) {
    EXPECT_GT(joints[left].y(), 0.0) << "left is to the left of who looks along x";
    EXPECT_LT(
        (joints[left] - Vec3(joints[right].x(), -joints[right].y(), joints[right].z())).norm(),
        1e-12);
  }
}

TEST(Body, LegsSwingByTurns) {
  PersonState state;
  state.velocity_enu_m_s = {1.5, 0, 0};
  state.stride_rad = kPi / 2.0;
  const auto half_a_step = joints_enu_m(state, 1.75);
  state.stride_rad = -kPi / 2.0;
  const auto next = joints_enu_m(state, 1.75);
  EXPECT_GT(std::abs(half_a_step[27].x() - half_a_step[28].x()), 0.3);
  EXPECT_LT((half_a_step[27].x() - half_a_step[28].x()) * (next[27].x() - next[28].x()), 0.0);
}

}  // namespace
}  // namespace foretrack
