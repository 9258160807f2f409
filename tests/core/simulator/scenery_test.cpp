// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/scenery.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

World with_shapes() {
  World world;
  world.boxes = {{{1.0, -1.0, 0.0}, {3.0, 1.0, 3.0}}, {{-5.0, 2.0, 0.0}, {-2.0, 2.6, 1.3}}};
  world.cylinders = {{{6.0, 6.0}, 0.7, 3.5, 0.0}};
  return world;
}

Vec3 corner_of(const Face& face, int i) {
  return face.corners[i].camera_m.cast<double>();
}
Vec3 normal_of(const Face& face) {
  return (corner_of(face, 1) - corner_of(face, 0))
      .cross(corner_of(face, 2) - corner_of(face, 0))
      .normalized();
}
Vec3 middle_of(const Face& face) {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < 4; ++i) sum += 0.25 * corner_of(face, i);
  return sum;
}

TEST(Scenery, FacesLieOnTheSurfacesOfTheirShapesAndLookOutwards) {
  const World world = with_shapes();
  const Scenery scenery = build_scenery(world);
  ASSERT_EQ(scenery.faces.size(), 1U + 2U * 5U + 24U * 2U);
  for (std::size_t i = 1; i < scenery.faces.size(); ++i) {
    const Face& face = scenery.faces[i];
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(clearance_m(world, corner_of(face, k)), 0.0, 1e-5);
    const Vec3 normal = normal_of(face), middle = middle_of(face);
    EXPECT_GT(clearance_m(world, middle + 0.05 * normal), 0.0) << i;
    EXPECT_LT(clearance_m(world, middle - 0.05 * normal), 0.0) << i;
  }
}

TEST(Scenery, TheGroundReachesFarBeyondTheBoundsAndLooksUp) {
  const World world = with_shapes();
  const Face ground = build_scenery(world).faces.front();
  EXPECT_EQ(ground.surface, Surface::kPaving);
  EXPECT_NEAR(normal_of(ground).z(), 1.0, 1e-6);
  EXPECT_EQ(corner_of(ground, 0).z(), world.min_m.z());
  EXPECT_LT(corner_of(ground, 0).x(), world.min_m.x() - 100.0);
  EXPECT_GT(corner_of(ground, 2).y(), world.max_m.y() + 100.0);
}

TEST(Scenery, LowBoxesAreHedgesAndHighOnesAreNot) {
  const Scenery scenery = build_scenery(with_shapes());
  for (std::size_t i = 1; i <= 5; ++i) EXPECT_NE(scenery.faces[i].surface, Surface::kLeaves);
  for (std::size_t i = 6; i <= 10; ++i) EXPECT_EQ(scenery.faces[i].surface, Surface::kLeaves);
}

TEST(Scenery, TexturesHaveTheStatedSizeOnEveryFace) {
  for (const Face& face : build_scenery(with_shapes()).faces) {
    if (face.surface == Surface::kRoof) continue;  // lids of cylinders are three corners wide
    const double tile_m = kSurfaceTile_m[static_cast<std::size_t>(face.surface)];
    const auto &a = face.corners[0], &b = face.corners[1], &c = face.corners[2];
    EXPECT_NEAR((b.u - a.u) * tile_m, (corner_of(face, 1) - corner_of(face, 0)).norm(), 1e-2);
    EXPECT_NEAR((c.v - b.v) * tile_m, (corner_of(face, 2) - corner_of(face, 1)).norm(), 1e-2);
  }
}

TEST(Daylight, IsGreatestTowardsTheSunAndLeastAwayFromIt) {
  const Eigen::Vector3f sun = sun_direction();
  EXPECT_NEAR(sun.norm(), 1.0F, 1e-6F);
  EXPECT_GT(sun.z(), 0.0F);
  const float facing = daylight(sun), away = daylight(-sun);
  for (int k = 0; k < 24; ++k) {
    const Vec2 d = direction_of(k * kPi / 12.0);
    const float wall =
        daylight(Eigen::Vector3f(static_cast<float>(d.x()), static_cast<float>(d.y()), 0.0F));
    EXPECT_LT(wall, facing);
    EXPECT_GT(wall, away);
  }
  EXPECT_GT(away, 0.4F) << "shades are not black";
}

}  // namespace
}  // namespace foretrack
