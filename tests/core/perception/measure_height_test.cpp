// SPDX-License-Identifier: Apache-2.0
#include "core/perception/measure_height.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/common/random.hpp"
#include "core/common/vehicle.hpp"
#include "core/simulator/body.hpp"

namespace foretrack {
namespace {

constexpr double kAdult_m = 1.75, kVisible = 0.5;

/// Somebody on their feet before a camera, and how tall the image shows them to be.
struct Sight {
  CameraModel camera = {};
  double away_m = 4.0, camera_m = 1.5, ground_m = 0.0, noise_px = 0.0;
  double stride_rad = 0.0, speed_m_s = 0.0, body_yaw_rad = 2.0;
  std::uint64_t seed = 1;

  std::array<Landmark, kLandmarkCount> landmarks(double height_m) const {
    foretrack::PersonState person;
    person.position_enu_m = {away_m, 0.3, ground_m + torso_height_m(height_m)};
    person.body_yaw_rad = body_yaw_rad;
    person.velocity_enu_m_s.head<2>() = speed_m_s * direction_of(body_yaw_rad);
    person.stride_rad = stride_rad;
    const auto joints = joints_enu_m(person, height_m);
    Random random(seed);
    std::array<Landmark, kLandmarkCount> marks{};
    for (int k = 0; k < kLandmarkCount; ++k)
      if (const auto px = camera.project(T_world_camera().inverse() * joints[k])) {
        marks[k].image_px = *px + noise_px * Vec2(random.normal(0.0, 1.0), random.normal(0.0, 1.0));
        marks[k].visibility = 1.0;
      }
    return marks;
  }
  Pose T_world_camera() const {
    VehicleState vehicle;
    vehicle.position_enu_m = {0.0, 0.0, ground_m + camera_m};
    return vehicle.T_world_body() * camera.T_body_camera;
  }
  std::optional<double> measured(double height_m = kAdult_m) const {
    return measure_height(landmarks(height_m), camera, T_world_camera(), ground_m, kVisible);
  }
};

TEST(MeasureHeight, ChildrenAndTallPeopleAreMeasuredWithoutBeingTold) {
  for (const double height_m : {1.0, 1.25, 1.5, 1.75, 2.0})
    for (const double yaw_rad : {0.0, 1.0, 2.0, 3.1}) {
      const auto measured = Sight{.body_yaw_rad = yaw_rad}.measured(height_m);
      ASSERT_TRUE(measured) << height_m;
      EXPECT_NEAR(*measured, height_m, 0.06) << yaw_rad;
    }
}

TEST(MeasureHeight, WalkingAndNoiseChangeItByLittle) {
  for (const double away_m : {3.0, 5.0}) {
    double sum = 0.0, worst = 0.0;
    constexpr int kLooks = 60;
    for (int i = 0; i < kLooks; ++i) {
      const auto measured = Sight{.away_m = away_m,
                                  .noise_px = 2.0,
                                  .stride_rad = 0.7 * i,
                                  .speed_m_s = 1.3,
                                  .seed = 100u + static_cast<std::uint64_t>(i)}
                                .measured();
      ASSERT_TRUE(measured);
      sum += *measured / kLooks;
      worst = std::max(worst, std::abs(*measured - kAdult_m));
    }
    EXPECT_NEAR(sum, kAdult_m, 0.05) << away_m;
    EXPECT_LT(worst, 0.25) << away_m;
  }
}

TEST(MeasureHeight, CountsFromTheGroundThatItIsTold) {
  Sight sight{.ground_m = 30.0};
  ASSERT_TRUE(sight.measured());
  EXPECT_NEAR(*sight.measured(), kAdult_m, 0.06);
  const auto marks = sight.landmarks(kAdult_m);
  EXPECT_FALSE(measure_height(marks, sight.camera, sight.T_world_camera(), 32.0, kVisible))
      << "the camera would be below the ground";
}

TEST(MeasureHeight, SaysNothingWithoutHeelsOrEarsOrFromTooFlat) {
  Sight sight;
  for (const int unseen : {7, 8, 29, 30}) {
    auto marks = sight.landmarks(kAdult_m);
    marks[unseen].visibility = 0.2;
    EXPECT_FALSE(measure_height(marks, sight.camera, sight.T_world_camera(), 0.0, kVisible))
        << unseen;
  }
  sight.away_m = 15.0;
  EXPECT_FALSE(sight.measured()) << "a pixel is half a metre there";
}

}  // namespace
}  // namespace foretrack
