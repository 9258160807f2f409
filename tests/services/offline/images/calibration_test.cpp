// SPDX-License-Identifier: Apache-2.0
#include "services/offline/images/calibration.hpp"

#include <gmock/gmock.h>

#include "tests/services/offline/images/scratch_folder.hpp"

namespace foretrack {
namespace {

using ::testing::HasSubstr;

constexpr char kGood[] = R"(image_width: 640
image_height: 480
camera_name: narrow_stereo
camera_matrix:
  rows: 3
  cols: 3
  data: [430.2, 0., 306.9, 0., 430.5, 227.2, 0., 0., 1.]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.337, 0.111, -0.0002, 0.0003, 0.]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1., 0., 0., 0., 1., 0., 0., 0., 1.]
projection_matrix:
  rows: 3
  cols: 4
  data: [352.9, 0., 306.1, 0., 0., 390.9, 226.3, 0., 0., 0., 1., 0.]
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::string fault_of(const std::string& text) {
  const testing::ScratchFolder folder;
  try {
    load_calibration(folder.write("camera.yaml", text));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(LoadCalibration, ReadsWhatRosWrites) {
  const testing::ScratchFolder folder;
  const auto c = load_calibration(folder.write("camera.yaml", kGood));
  EXPECT_EQ(c.camera.width_px, 640);
  EXPECT_EQ(c.camera.height_px, 480);
  EXPECT_EQ(c.camera.fx_px, 430.2);
  EXPECT_EQ(c.camera.cy_px, 227.2);
  EXPECT_TRUE(c.lens.distorts());
  EXPECT_EQ(c.lens.coefficients[1], 0.111);
}

TEST(LoadCalibration, NamesEveryFaultWithItsLine) {
  const std::string fault = fault_of(
      replaced(replaced(kGood, "image_width: 640", "image_width: wide"), "0., 1.]", "1.]"));
  EXPECT_THAT(fault, HasSubstr("image_width"));
  EXPECT_THAT(fault, HasSubstr("camera_matrix.data: 9 numbers expected"));
}

TEST(LoadCalibration, RefusesUnknownLensesAndNegativeFocalLengths) {
  EXPECT_THAT(fault_of(replaced(kGood, "plumb_bob", "origami")), HasSubstr("origami"));
  EXPECT_THAT(fault_of(replaced(kGood, "430.2", "-430.2")), HasSubstr("camera_matrix.data"));
  EXPECT_THAT(fault_of("[1, 2]"), HasSubstr("a camera calibration expected"));
  EXPECT_THAT(fault_of("a: b"), HasSubstr("image_height"));
  EXPECT_THROW(load_calibration("/nowhere.yaml"), std::invalid_argument);
}

}  // namespace
}  // namespace foretrack
