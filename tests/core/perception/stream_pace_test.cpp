// SPDX-License-Identifier: Apache-2.0
#include "core/perception/stream_pace.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace foretrack {
namespace {

struct Sent {
  int pictures = 0;
  double kbit_s = 0.0;
  double quality = 0.0;  // of the last
};

// A camera of that rate, whose pictures have the bytes that `size` says for a quality. The first
// five seconds, in which the quality settles, are not counted.
Sent stream(const StreamParams& params, double camera_hz,
            const std::function<double(int quality)>& size, double seconds = 20.0) {
  constexpr double kSettled_s = 5.0;
  StreamPace pace;
  Sent result;
  double bytes = 0.0;
  for (int i = 0; i < (kSettled_s + seconds) * camera_hz; ++i) {
    const double stamp_s = 100.0 + i / camera_hz;
    if (!is_due(pace, stamp_s, params)) continue;
    result.quality = quality_of(pace, params);
    const double of_picture = size(quality_of(pace, params));
    sent(pace, stamp_s, of_picture, params);
    if (stamp_s < 100.0 + kSettled_s) continue;
    ++result.pictures;
    bytes += of_picture;
  }
  result.kbit_s = bytes * 8.0 / 1000.0 / seconds;
  return result;
}

double busy_street(int quality) {
  return 3000.0 + 300.0 * quality;
}

TEST(StreamPaceTest, TheQualitySettlesWhereTheBandwidthIsUsedAndKept) {
  const Sent result = stream({}, 30.0, busy_street);
  EXPECT_NEAR(result.pictures, 300, 2);
  EXPECT_LT(result.kbit_s, 1.05 * StreamParams{}.bandwidth_kbit_s);
  EXPECT_GT(result.kbit_s, 0.75 * StreamParams{}.bandwidth_kbit_s);
}

TEST(StreamPaceTest, WhereTheWorstQualityIsTooLargeFewerPicturesAreSent) {
  const StreamParams params{.bandwidth_kbit_s = 400.0};
  const Sent result = stream(params, 30.0, busy_street);
  EXPECT_EQ(result.quality, params.quality_min);
  EXPECT_NEAR(result.pictures, 95, 10);
  EXPECT_LT(result.kbit_s, 1.05 * params.bandwidth_kbit_s);
}

TEST(StreamPaceTest, SmallPicturesAreNoBetterThanTheBestQuality) {
  const Sent result = stream({}, 30.0, [](int) { return 500.0; });
  EXPECT_EQ(result.quality, StreamParams{}.quality_max);
  EXPECT_NEAR(result.pictures, 300, 2);
}

TEST(StreamPaceTest, TheRateIsKeptAlsoWhereTheCamerasIsNoMultipleOfIt) {
  const Sent result = stream({.rate_hz = 15.0}, 25.0, [](int) { return 500.0; });
  EXPECT_NEAR(result.pictures, 300, 3);
  EXPECT_NEAR(stream({.rate_hz = 30.0}, 25.0, [](int) { return 500.0; }).pictures, 500, 2);
}

TEST(StreamPaceTest, AClockThatWasSetBackBeginsAnew) {
  StreamPace pace;
  ASSERT_TRUE(is_due(pace, 500.0, {}));
  sent(pace, 500.0, 1e6, {});
  EXPECT_TRUE(is_due(pace, 3.0, {}));
}

TEST(StreamPaceTest, NothingIsDueWhereItIsSwitchedOff) {
  StreamPace pace;
  EXPECT_FALSE(is_due(pace, 500.0, {.enabled = false}));
}

TEST(StreamPaceTest, AWorstQualityAboveTheBestCounts) {
  EXPECT_EQ(quality_of({}, {.quality_min = 70, .quality_max = 30}), 70);
}

}  // namespace
}  // namespace foretrack
