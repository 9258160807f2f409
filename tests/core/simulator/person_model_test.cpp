// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/person_model.hpp"

#include <gtest/gtest.h>

#include "core/simulator/scenery.hpp"
#include "tests/support/mannequin.hpp"

namespace foretrack {
namespace {

using testing::walking;

TEST(PersonModel, JointsAreWhereTheSimulatedPersonHasThem) {
  // A mesh that is nothing but a small triangle at each joint.
  const Skeleton s = testing::standing_skeleton();
  const std::pair<const Skeleton::Side*, int> sides[] = {
      {&s.shoulder, 11}, {&s.elbow, 13}, {&s.wrist, 15}, {&s.hip, 23},
      {&s.knee, 25},     {&s.ankle, 27}, {&s.toes, 31}};
  PersonMesh mesh;
  mesh.textures = {make_texture({1, 1, {9, 9, 9}})};
  for (const double z : {0.0, 1.0})
    testing::add_bone(mesh, Eigen::Vector3f(0, 0, z), Eigen::Vector3f(0, 0, z), 0.0F, 0);
  for (const auto& [side, left] : sides)
    for (const auto& place : *side) testing::add_bone(mesh, place, place, 0.001F, 0);
  // The mesh is centred on its bounding box; the markers are not.
  Eigen::Vector3f low = mesh.vertices[0].position, high = low;
  for (const auto& v : mesh.vertices)
    low = low.cwiseMin(v.position), high = high.cwiseMax(v.position);
  const Eigen::Vector3f middle(0.5F * (low.x() + high.x()), 0.5F * (low.y() + high.y()), 0.0F);
  Skeleton centred = s;
  for (auto* side : {&centred.shoulder, &centred.elbow, &centred.wrist, &centred.fingertips,
                     &centred.hip, &centred.knee, &centred.ankle, &centred.toes})
    for (auto& place : *side) place -= middle;
  const PersonModel model = make_person_model(std::move(mesh), centred);
  std::vector<Corner> posed;
  for (const double height_m : {1.6, 1.9})
    for (double phase = 0.0; phase < 6.0; phase += 0.7) {
      PersonState person = walking(1.0 + phase, phase);
      const auto joints = joints_enu_m(person, height_m);
      pose_person(model, joints, height_m, posed);
      std::size_t first = 16;
      for (const auto& [side, left] : sides)
        for (const int i : {0, 1}) {
          Eigen::Vector3f mean = Eigen::Vector3f::Zero();
          for (int k = 0; k < 8; ++k) mean += posed[first + k].camera_m / 8.0F;
          first += 8;
          EXPECT_LT((mean.cast<double>() - joints[left + i]).norm(), 0.005) << left + i;
        }
    }
}

TEST(PersonModel, RefusesMeshesThatAreNone) {
  EXPECT_THROW(make_person_model({}, testing::standing_skeleton()), std::invalid_argument);
  PersonMesh mesh = testing::make_mannequin()->mesh;
  mesh.triangles[3].vertices[1] = 100000;
  EXPECT_THROW(make_person_model(mesh, testing::standing_skeleton()), std::invalid_argument);
}

TEST(PersonModel, ShadowsFallOnTheGroundAwayFromTheSun) {
  const auto mannequin = testing::make_mannequin();
  std::vector<Corner> posed, shadow;
  pose_person(*mannequin, joints_enu_m(walking(0.3, 1.0), 1.7), 1.7, posed);
  cast_shadow(posed, 0.0, shadow);
  ASSERT_EQ(shadow.size(), posed.size());
  const Eigen::Vector3f sun = sun_direction();
  for (std::size_t i = 0; i < posed.size(); ++i) {
    EXPECT_NEAR(shadow[i].camera_m.z(), 0.0F, 0.01F);
    // From the shadow, the point that cast it is where the sun is.
    const Eigen::Vector3f up = posed[i].camera_m - shadow[i].camera_m;
    if (up.z() < 0.05F) continue;
    EXPECT_LT((up.normalized() - sun).norm(), 1e-3F);
  }
}

TEST(PersonModel, EveryVertexIsBoundToItsTwoNearestBones) {
  const auto mannequin = testing::make_mannequin();
  ASSERT_EQ(mannequin->skin.size(), mannequin->mesh.vertices.size());
  for (const PersonModel::Skin& skin : mannequin->skin) {
    EXPECT_NE(skin.bones[0], skin.bones[1]);
    EXPECT_GE(skin.first_weight, 0.5F) << "the nearer one weighs more";
    EXPECT_LE(skin.first_weight, 1.0F);
    for (const int bone : skin.bones) EXPECT_TRUE(bone >= 0 && bone < kBoneCount);
  }
}

TEST(PersonModel, IsBroughtToHeightOneWhateverItsUnit) {
  PersonMesh mesh = testing::make_mannequin()->mesh;
  for (auto& v : mesh.vertices) v.position = 172.0F * v.position + Eigen::Vector3f(9, -4, 30);
  const PersonModel model = make_person_model(mesh, testing::standing_skeleton());
  float low = 1e9F, high = -1e9F;
  for (const auto& v : model.mesh.vertices) {
    low = std::min(low, v.position.z());
    high = std::max(high, v.position.z());
  }
  EXPECT_NEAR(low, 0.0F, 1e-5F);
  EXPECT_NEAR(high, 1.0F, 1e-5F);
}

}  // namespace
}  // namespace foretrack
