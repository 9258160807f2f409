// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/rest_pose.hpp"

#include <gtest/gtest.h>

#include "tests/support/mannequin.hpp"

namespace foretrack {
namespace {

using Vec3f = Eigen::Vector3f;

void turn_shoulders(Skeleton& s, float yaw) {
  const Vec3f neck = 0.5F * (s.shoulder[0] + s.shoulder[1]);
  const Eigen::AngleAxisf turn(yaw, Vec3f::UnitZ());
  for (Vec3f& shoulder : s.shoulder) shoulder = neck + turn * (shoulder - neck);
}

TEST(Unwind, TurnsShouldersAheadAndLeavesTheHips) {
  const Skeleton straight = testing::standing_skeleton();
  Skeleton s = straight;
  turn_shoulders(s, 0.4F);
  PersonMesh mesh;
  for (const Vec3f& p : {s.shoulder[0], s.hip[0]}) mesh.vertices.push_back({p});
  unwind(mesh, s);
  for (const int i : {0, 1}) {
    EXPECT_LT((s.shoulder[i] - straight.shoulder[i]).norm(), 1e-5F);
    EXPECT_LT((s.hip[i] - straight.hip[i]).norm(), 1e-5F);
  }
  EXPECT_LT((mesh.vertices[0].position - straight.shoulder[0]).norm(), 1e-5F);
  EXPECT_LT((mesh.vertices[1].position - straight.hip[0]).norm(), 1e-5F);
}

TEST(Unwind, ASpineTurnsGraduallyAndNormalsWithIt) {
  Skeleton s = testing::standing_skeleton();
  const Vec3f middle = 0.25F * (s.shoulder[0] + s.shoulder[1] + s.hip[0] + s.hip[1]);
  turn_shoulders(s, 0.4F);
  PersonMesh mesh;
  mesh.vertices.push_back({middle + Vec3f(0.1F, 0.0F, 0.0F), Vec3f::UnitX()});
  unwind(mesh, s);
  const auto& v = mesh.vertices.front();
  EXPECT_NEAR(std::atan2(v.normal.y(), v.normal.x()), -0.2F, 1e-4F);
  EXPECT_LT((v.position - middle - 0.1F * v.normal).norm(), 1e-5F);
}

// Two shoes side by side whose halves are on the other leg's side.
TEST(LegOfEachVertex, GoesByWhatHangsTogether) {
  Skeleton s = testing::standing_skeleton();
  PersonMesh mesh;
  testing::add_bone(mesh, s.ankle[0], s.toes[0] - Vec3f(0.0F, 0.07F, 0.0F), 0.01F, 0);
  const auto left = mesh.vertices.size();
  testing::add_bone(mesh, s.ankle[1], s.toes[1], 0.01F, 0);
  const auto legs = leg_of_each_vertex(mesh, s);
  EXPECT_LT(mesh.vertices[0].position.y(), 0.0F);
  for (std::size_t v = 0; v < legs.size(); ++v) EXPECT_EQ(legs[v], v < left ? 0 : 1) << v;
}

TEST(LegOfEachVertex, AboveTheKneesGoesBySide) {
  const Skeleton s = testing::standing_skeleton();
  PersonMesh mesh;
  for (const Vec3f& p : {s.hip[0], s.hip[1], s.wrist[0]}) mesh.vertices.push_back({p});
  EXPECT_EQ(leg_of_each_vertex(mesh, s), (std::vector<int>{0, 1, 0}));
}

}  // namespace
}  // namespace foretrack
