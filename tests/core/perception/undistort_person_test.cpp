// SPDX-License-Identifier: Apache-2.0
#include "core/perception/undistort_person.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace foretrack {
namespace {

TEST(UndistortPerson, LandmarksFarOutsideTheLensBecomeInvisible) {
  const CameraModel camera;
  const Lens lens = lens_of("plumb_bob", std::vector{-0.4, 0.0, 0.0, 0.0, 0.0});
  PersonPose person;
  person.landmarks[3] = {{5000.0, 240.0}, Vec3::Zero(), 1.0};
  person.landmarks[4] = {{400.0, 240.0}, Vec3::Zero(), 1.0};
  undistort(person, camera, lens);
  EXPECT_EQ(person.landmarks[3].visibility, 0.0);
  EXPECT_EQ(person.landmarks[4].visibility, 1.0);
  EXPECT_GT(person.landmarks[4].image_px.x(), 400.0);
}

}  // namespace
}  // namespace foretrack
