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
  EXPECT_THAT(fault, HasSubstr("yaml:5: camera_matrix: a list of 9 numbers expected"));
}

TEST(LoadCalibration, RefusesUnknownLensesAndNegativeFocalLengths) {
  EXPECT_THAT(fault_of(replaced(kGood, "plumb_bob", "origami")), HasSubstr("origami"));
  EXPECT_THAT(fault_of(replaced(kGood, "430.2", "-430.2")),
              HasSubstr("camera_matrix: fx is -430.2 px"));
  EXPECT_THAT(fault_of("[1, 2]"), HasSubstr("a camera calibration expected"));
  EXPECT_THAT(fault_of("a: b"), HasSubstr("image_height"));
  EXPECT_THROW(load_calibration("/nowhere.yaml"), std::invalid_argument);
}

CameraWithLens load(const std::string& text) {
  const testing::ScratchFolder folder;
  return load_calibration(folder.write("camera.yaml", text));
}

TEST(LoadCalibration, RefusesNumbersThatNoCameraHas) {
  constexpr const char* kMatrix = "[430.2, 0., 306.9, 0., 430.5, 227.2, 0., 0., 1.]";
  const auto with_matrix = [&](const char* matrix) {
    return fault_of(replaced(kGood, kMatrix, matrix));
  };
  EXPECT_THAT(
      with_matrix("[430, 0, 1320, 0, 430, 227, 0, 0, 1]"),
      HasSubstr("yaml:5: camera_matrix: cx is 1320 px, within the image's 640 px expected"));
  EXPECT_THAT(with_matrix("[430, 0, 0, 0, 430, 0, 306, 227, 1]"), HasSubstr("transposed"));
  EXPECT_THAT(with_matrix("[430, 37, 306, 99, 430, 227, 5, 5, 5]"),
              ::testing::AllOf(HasSubstr("last row is 5 5 5"), HasSubstr("37 and 99")));
  EXPECT_THAT(with_matrix("[43000, 0, 306, 0, 43000, 227, 0, 0, 1]"),
              HasSubstr("from side to side"));
  EXPECT_THAT(fault_of(std::string(kGood) + "image_width: 320\n"),
              HasSubstr("image_width: given twice"));
  EXPECT_THAT(fault_of(std::string(kGood) + "---\n" + kGood), HasSubstr("2 documents"));
}

TEST(LoadCalibration, ReadsWhatOtherToolsWrite) {
  const std::string list = replaced(
      kGood,
      "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: ", "distortion_coefficients: ");
  EXPECT_EQ(load(list).lens.coefficients[0], -0.337);
  const std::string eight =
      replaced(replaced(kGood, "cols: 5", "cols: 8"), "0.0003, 0.]", "0.0003, 0., 0.1, 0., 0.]");
  EXPECT_EQ(load(eight).lens.model, Lens::Model::kRationalPolynomial);
  const std::string none =
      replaced(replaced(kGood, "plumb_bob", "none"), "-0.337, 0.111, -0.0002, 0.0003, 0.", "");
  EXPECT_FALSE(load(none).lens.distorts());
  constexpr char kEcho[] =
      "header:\n  stamp: {sec: 1, nanosec: 0}\n  frame_id: cam\nheight: 480\nwidth: 640\n"
      "distortion_model: plumb_bob\nd:\n- -0.35\n- 0.12\n- 0.0\n- 0.0\n- 0.0\n"
      "k:\n- 520.0\n- 0.0\n- 320.0\n- 0.0\n- 520.0\n- 240.0\n- 0.0\n- 0.0\n- 1.0\n---\n";
  EXPECT_EQ(load(kEcho).camera.fx_px, 520.0);
  EXPECT_EQ(load(kEcho).lens.coefficients[1], 0.12);
  EXPECT_EQ(describe(load(kEcho)), "640 × 480 px, 63° × 50° of view");
}

}  // namespace
}  // namespace foretrack
