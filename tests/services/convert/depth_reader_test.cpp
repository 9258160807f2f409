// SPDX-License-Identifier: Apache-2.0
#include "services/convert/depth_reader.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace foretrack {
namespace {

// What is seen of a wall that ends at 20° to the left, through a barrel.
TEST(DepthReader, StraightensWhatALensHasBent) {
  const CameraModel model = CameraModel::from_fov(160, 120, rad(80), rad(64));
  const CameraWithLens camera{model, lens_of("plumb_bob", std::vector{-0.25, 0.05, 0.0, 0.0, 0.0})};
  const double edge_px = model.cx_px - model.fx_px * std::tan(rad(35.0));
  DepthImage bent{1.0, model, std::vector<float>(160 * 120, 2.0F)};
  for (int row = 0; row < 120; ++row)
    for (int column = 0; column < 160; ++column)
      if (undistort({column + 0.5, row + 0.5}, model, camera.lens)->x() < edge_px)
        bent.depth_m[static_cast<std::size_t>(160 * row + column)] = 0.0F;
  sensor_msgs::msg::Image message;
  to_idl(bent, message);
  DepthReader with_lens(camera), without({model, {}});
  const auto edge_of = [](const DepthImage& image, int row) {
    int column = 0;
    while (image.depth_m[static_cast<std::size_t>(160 * row + column)] == 0.0F) ++column;
    return column;
  };
  const auto straight = with_lens.convert(message);
  ASSERT_TRUE(straight) << straight.fault().text;
  for (const int row : {10, 60, 110}) EXPECT_NEAR(edge_of(*straight, row), edge_px, 1.5);
  EXPECT_GT(edge_of(*without.convert(message), 60), edge_px + 5.0);
  EXPECT_TRUE(with_lens.is(camera));
  EXPECT_FALSE(with_lens.is({model, {}}));
  message.data().pop_back();
  EXPECT_FALSE(with_lens.convert(message));
}

}  // namespace
}  // namespace foretrack
