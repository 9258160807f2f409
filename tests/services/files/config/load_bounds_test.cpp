// SPDX-License-Identifier: Apache-2.0
#include "services/files/config/load_bounds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/error_of.hpp"

namespace foretrack {
namespace {

using testing::HasSubstr;

FlightBounds load(const std::string& text) {
  const auto file = std::filesystem::temp_directory_path() / "foretrack_load_bounds.yaml";
  std::ofstream(file) << text;
  return load_bounds(file);
}
std::string error_of(const std::string& text) {
  return foretrack::error_of([&] { load(text); });
}

TEST(LoadBounds, ReadsAFenceAndAltitudesAndEitherAlone) {
  const auto both =
      load("fence_m: [[-20, -10], [20, -10], [20, 30]]\naltitude_min_m: 1\naltitude_max_m: 12\n");
  ASSERT_EQ(both.corner_count, 3);
  EXPECT_EQ(both.corners_enu_m[2].y_m, 30.0);
  EXPECT_EQ(both.altitude_min_m, 1.0);
  EXPECT_EQ(both.altitude_max_m, 12.0);
  const auto ceiling = load("altitude_max_m: 12\n");
  EXPECT_EQ(ceiling.corner_count, 0);
  EXPECT_EQ(ceiling.altitude_min_m, FlightBounds{}.altitude_min_m);
  EXPECT_EQ(load("fence_m: []\n"), FlightBounds{}) << "lifts all bounds";
}

TEST(LoadBounds, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(error_of("{}"), HasSubstr("nothing is bounded"));
  EXPECT_THAT(error_of("fence_m: [[0, 0], [1, 1]]\n"), HasSubstr(":1: fence_m: is no fence"));
  EXPECT_THAT(error_of("fence_m: [[0, 0], [2, 2], [2, 0], [0, 2]]\n"), HasSubstr("do not cross"));
  EXPECT_THAT(error_of("altitude_min_m: 3\naltitude_max_m: 2\n"),
              HasSubstr(":2: altitude_max_m: is not above"));
  EXPECT_THAT(error_of("altitude_max_m: high\n"), HasSubstr("altitude_max_m"));
  EXPECT_THAT(error_of("fence_m: []\nceiling_m: 3\n"), HasSubstr("ceiling_m"));
  std::string many = "fence_m: [";
  for (int i = 0; i < 33; ++i) many += "[" + std::to_string(i) + ", 0],";
  EXPECT_THAT(error_of(many + "]\n"), HasSubstr("has 33 corners"));
}

}  // namespace
}  // namespace foretrack
