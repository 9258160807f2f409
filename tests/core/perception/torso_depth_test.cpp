// SPDX-License-Identifier: Apache-2.0
#include "core/perception/torso_depth.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"
#include "tests/core/perception/torso_pose.hpp"

namespace foretrack {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

TargetObservation person_in_the_middle() {
  TargetObservation o;
  o.landmarks = testing::pose_at({320.0, 240.0}, 400.0).landmarks;  // 280…360, 200…280
  return o;
}

DepthImage everywhere(float depth_m, const CameraModel& camera = CameraModel()) {
  DepthImage image;
  image.camera = camera;
  image.depth_m.assign(static_cast<std::size_t>(camera.width_px * camera.height_px), depth_m);
  return image;
}

// In each pixel of the torso, what `choose` says.
template <class Choose>
DepthImage torso(float background_m, Choose&& choose) {
  DepthImage image = everywhere(background_m);
  for (int y = 200; y < 280; ++y)
    for (int x = 280; x < 360; ++x) image.depth_m[static_cast<std::size_t>(640 * y + x)] = choose();
  return image;
}

TEST(TorsoSurfaceDepth, IsThatOfTheTorsoAndNotOfWhatIsAround) {
  const auto depth =
      torso_surface_depth_m(person_in_the_middle(), torso(6.0f, [] { return 2.5f; }));
  ASSERT_TRUE(depth);
  EXPECT_FLOAT_EQ(static_cast<float>(*depth), 2.5f);
}

TEST(TorsoSurfaceDepth, IsTheMedianSoThatHolesAndStraysDoNotMoveIt) {
  Random random(1);
  for (const float stray_m : {0.0f, kNaN, 5.0f, 0.05f, 100.0f}) {
    const auto depth = torso_surface_depth_m(
        person_in_the_middle(), torso(6.0f, [&] {
          return random.chance(0.25) ? stray_m : static_cast<float>(2.5 + 0.01 * random.normal());
        }));
    ASSERT_TRUE(depth) << stray_m;
    EXPECT_NEAR(*depth, 2.5, 0.02) << stray_m;
  }
}

TEST(TorsoSurfaceDepth, OfACameraOfAnotherSizeAndAngleIsTheSame) {
  const CameraModel wide = CameraModel::from_fov(320, 200, rad(110.0), rad(80.0));
  DepthImage image = everywhere(6.0f, wide);
  const CameraModel colour;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 320; ++x) {
      const Vec3 ray((x + 0.5 - wide.cx_px) / wide.fx_px, (y + 0.5 - wide.cy_px) / wide.fy_px, 1.0);
      const Vec2 px = *colour.project(ray);
      if (std::abs(px.x() - 320.0) < 40.0 && std::abs(px.y() - 240.0) < 40.0)
        image.depth_m[static_cast<std::size_t>(320 * y + x)] = 3.0f;
    }
  const auto depth = torso_surface_depth_m(person_in_the_middle(), image);
  ASSERT_TRUE(depth);
  EXPECT_EQ(*depth, 3.0);
}

TEST(TorsoSurfaceDepth, NeedsEnoughReturnsOnTheTorso) {
  const TargetObservation person = person_in_the_middle();
  EXPECT_FALSE(torso_surface_depth_m(person, everywhere(0.0f)));
  EXPECT_FALSE(torso_surface_depth_m(person, everywhere(kNaN)));
  EXPECT_FALSE(torso_surface_depth_m(person, everywhere(40.0f))) << "beyond any camera's range";
  EXPECT_FALSE(torso_surface_depth_m(person, DepthImage())) << "no pixels";
  TargetObservation outside = person;
  for (Landmark& l : outside.landmarks) l.image_px.x() += 400.0;
  EXPECT_FALSE(torso_surface_depth_m(outside, everywhere(2.0f)));
  Random random(2);
  EXPECT_FALSE(
      torso_surface_depth_m(person, torso(6.0f, [&] { return random.chance(0.1) ? 2.0f : 0.0f; })));
}

}  // namespace
}  // namespace foretrack
