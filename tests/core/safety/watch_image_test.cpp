// SPDX-License-Identifier: Apache-2.0
#include "core/safety/watch_image.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

/// A camera that flies by, 20 images a second, 0.1 m apart.
struct Camera {
  Random random{3};
  ImageWatch watch;
  double stamp_s = 0.0;

  std::vector<std::uint8_t> scene(int mean, int contrast) {
    std::vector<std::uint8_t> values(64 * 48 * 3);
    for (auto& value : values)
      value = static_cast<std::uint8_t>(mean + random.integer(-contrast, contrast));
    return values;
  }
  std::vector<float> depths(float nearest_m, float share) {
    std::vector<float> out(64 * 48);
    for (auto& depth : out)
      depth = random.chance(share) ? nearest_m + static_cast<float>(random.uniform()) : 0.0F;
    return out;
  }
  ImageFault color(const std::vector<std::uint8_t>& image, double moved_m = 0.1) {
    stamp_s += 0.05;
    return watch_color(watch, statistics_of(std::span<const std::uint8_t>(image)), moved_m, stamp_s,
                       {});
  }
  ImageFault depth(const std::vector<float>& image, double moved_m = 0.1) {
    stamp_s += 0.05;
    return watch_depth(watch, statistics_of(std::span<const float>(image)), moved_m, stamp_s, {});
  }
};

TEST(WatchImage, AnOrdinarySceneIsNoFault) {
  Camera camera, deep;
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(camera.color(camera.scene(90, 60)), ImageFault::kNone);
    EXPECT_EQ(deep.depth(deep.depths(0.8F, 0.7F)), ImageFault::kNone);
  }
}

TEST(WatchImage, TheSameImageWhileTheVehicleMovesIsAFrozenOne) {
  Camera camera, deep;
  const auto image = camera.scene(90, 60);
  const auto depths = deep.depths(0.8F, 0.7F);
  ImageFault color = ImageFault::kNone, depth = ImageFault::kNone;
  for (int i = 0; i < 6; ++i) color = camera.color(image), depth = deep.depth(depths);
  EXPECT_EQ(color, ImageFault::kFrozen);
  EXPECT_EQ(depth, ImageFault::kFrozen);
  for (int i = 0; i < 30; ++i) color = camera.color(camera.scene(90, 60));
  EXPECT_EQ(color, ImageFault::kNone) << "it sees again";
}

TEST(WatchImage, TheSameImageOfAVehicleThatStandsIsNone) {
  Camera camera;
  const auto image = camera.scene(90, 60);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(camera.color(image, 0.0), ImageFault::kNone);
}

TEST(WatchImage, DarkAndCoveredAreSaidAfterAMoment) {
  Camera dark, flat;
  EXPECT_EQ(dark.color(dark.scene(3, 2)), ImageFault::kNone);
  ImageFault fault = ImageFault::kNone;
  for (int i = 0; i < 12; ++i) fault = dark.color(dark.scene(3, 2));
  EXPECT_EQ(fault, ImageFault::kDark);
  for (int i = 0; i < 12; ++i) fault = flat.color(flat.scene(120, 1));
  EXPECT_EQ(fault, ImageFault::kCovered);
}

TEST(WatchImage, DepthThatIsNowhereOrAllTooNearIsCovered) {
  Camera none, near;
  ImageFault fault = ImageFault::kNone;
  for (int i = 0; i < 12; ++i) fault = none.depth(none.depths(1.0F, 0.001F));
  EXPECT_EQ(fault, ImageFault::kCovered);
  std::vector<float> close(64 * 48, 0.05F);
  for (int i = 0; i < 12; ++i) {
    close[0] = 0.05F + 0.001F * static_cast<float>(i);
    fault = near.depth(close);
  }
  EXPECT_EQ(fault, ImageFault::kCovered);
}

TEST(WatchImage, DepthWhereNothingIsWithinReachIsNeitherCoveredNorFrozen) {
  Camera high;
  const std::vector<float> sky(64 * 48, INFINITY);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(high.depth(sky), ImageFault::kNone);
}

TEST(WatchImage, StatisticsCountWhatIsThere) {
  const std::vector<std::uint8_t> grey(1600, 100);
  const auto color = statistics_of(std::span<const std::uint8_t>(grey));
  EXPECT_DOUBLE_EQ(color.mean, 100.0);
  EXPECT_DOUBLE_EQ(color.deviation, 0.0);
  std::vector<float> half(1600, 2.0F);
  for (std::size_t i = 0; i < half.size(); i += 8) half[i] = i % 16 ? NAN : INFINITY;
  const auto depth = statistics_of(std::span<const float>(half));
  EXPECT_DOUBLE_EQ(depth.valid_share, 0.75);
  EXPECT_DOUBLE_EQ(depth.mean, 2.0);
  half[4] = 2.5F;
  EXPECT_NE(statistics_of(std::span<const float>(half)).fingerprint, depth.fingerprint);
  EXPECT_EQ(statistics_of(std::span<const float>()).valid_share, 0.0);
}

TEST(WatchImage, EveryFaultHasAName) {
  EXPECT_EQ(to_string(ImageFault::kCovered), "covered");
  EXPECT_EQ(to_string(ImageFault::kNone), "");
}

}  // namespace
}  // namespace foretrack
