// SPDX-License-Identifier: Apache-2.0
#include "core/perception/appearance.hpp"

#include <gtest/gtest.h>

#include "tests/core/perception/torso_pose.hpp"

namespace foretrack {
namespace {

using testing::pose_at;
using testing::Rgb;
using testing::two_colours;

constexpr int kMiddle = 100;

std::optional<Appearance> seen(const Rgb& shirt, const Rgb& trousers,
                               const Vec2& torso_px = {kMiddle, kMiddle}) {
  return appearance_of(two_colours(200, 200, kMiddle, shirt, trousers), pose_at(torso_px, 150.0));
}

Rgb scaled(const Rgb& colour, double factor) {
  Rgb out;
  for (int k = 0; k < 3; ++k) out[k] = static_cast<std::uint8_t>(factor * colour[k]);
  return out;
}

TEST(Appearance, UpperAndLowerHalfAreToldApart) {
  const auto red_blue = seen({200, 40, 40}, {40, 40, 200});
  const auto blue_red = seen({40, 40, 200}, {200, 40, 40});
  ASSERT_TRUE(red_blue && blue_red);
  EXPECT_EQ(red_blue->colors.head<3>(), blue_red->colors.tail<3>());
  EXPECT_GT(difference(*red_blue, *blue_red), 1.0);
}

TEST(Appearance, RedAndGreyDifferByOne) {
  const auto red = seen({180, 60, 60}, {180, 60, 60}),
             grey = seen({100, 100, 100}, {100, 100, 100});
  EXPECT_NEAR(difference(*red, *grey), 1.3, 0.4);
  EXPECT_EQ(difference(*red, *red), 0.0);
  EXPECT_EQ(difference(*red, *grey), difference(*grey, *red));
}

TEST(Appearance, TheBrightnessOfTheLightMattersLessThanTheColour) {
  const Rgb shirt = {200, 80, 120}, trousers = {60, 160, 100};
  const auto light = seen(shirt, trousers);
  const auto dim = seen(scaled(shirt, 0.7), scaled(trousers, 0.7));
  const auto other = seen({80, 200, 120}, trousers);
  EXPECT_LT(difference(*light, *dim), 0.3);
  EXPECT_GT(difference(*light, *other), 3.0 * difference(*light, *dim));
}

TEST(Appearance, ATorsoOutsideTheImageHasNone) {
  EXPECT_TRUE(seen({200, 40, 40}, {40, 40, 200}, {100, 100}));
  EXPECT_FALSE(seen({200, 40, 40}, {40, 40, 200}, {300, 100}));
  EXPECT_FALSE(seen({200, 40, 40}, {40, 40, 200}, {100, -100}));
  EXPECT_FALSE(seen({200, 40, 40}, {40, 40, 200}, {100, 198})) << "the lower half is below";
  EXPECT_FALSE(seen({200, 40, 40}, {40, 40, 200}, Vec2::Constant(std::nan(""))));
}

TEST(Appearance, IsLearntByTheShareOfWhatIsNew) {
  Appearance known, now;
  known.colors << 0.0, 1.0, 2.0, 3.0, 4.0, 5.0;
  now.colors << 1.0, 1.0, 2.0, 3.0, 4.0, -5.0;
  learn(known, now, 0.1);
  EXPECT_NEAR(known.colors[0], 0.1, 1e-12);
  EXPECT_NEAR(known.colors[5], 4.0, 1e-12);
  learn(known, now, 1.0);
  EXPECT_NEAR(difference(known, now), 0.0, 1e-12);
}

TEST(Appearance, LegsAreLookedAtWhereTheyAreSeen) {
  PersonPose pose = pose_at({100, 60}, 100.0);
  const auto image = two_colours(200, 200, 80, {200, 40, 40}, {40, 40, 200});
  EXPECT_FALSE(appearance_of(image, pose)->legs_seen) << "their joints are not visible";
  const auto put = [&](int joint, double x, double y) {
    pose.landmarks[static_cast<std::size_t>(joint)].image_px = {x, y};
    pose.landmarks[static_cast<std::size_t>(joint)].visibility = 1.0;
  };
  put(kLeftHip, 110, 90), put(kRightHip, 90, 90);
  put(25, 110, 130), put(26, 90, 130);
  put(27, 110, 170), put(28, 90, 170);
  const auto seen = appearance_of(image, pose);
  ASSERT_TRUE(seen && seen->legs_seen);
  EXPECT_LT(seen->legs[0], 0.1);
  EXPECT_GT(seen->legs[1], 1.0) << "they are blue";
  EXPECT_EQ(seen->legs.head<3>(), seen->legs.tail<3>());
}

}  // namespace
}  // namespace foretrack
