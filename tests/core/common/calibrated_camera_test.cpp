// SPDX-License-Identifier: Apache-2.0
#include "core/common/calibrated_camera.hpp"

#include <gmock/gmock.h>

namespace foretrack {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Matrix = std::array<double, 9>;

constexpr Matrix kGood = {520.0, 0.0, 320.0, 0.0, 520.0, 240.0, 0.0, 0.0, 1.0};

Matrix with(std::initializer_list<std::pair<int, double>> changes) {
  Matrix k = kGood;
  for (const auto& [at, value] : changes) k[static_cast<std::size_t>(at)] = value;
  return k;
}

CameraWithLens camera(double fx_px, std::string_view model = "",
                      std::vector<double> coefficients = {}) {
  return {camera_of_matrix(640, 480, with({{0, fx_px}, {4, fx_px}})), lens_of(model, coefficients)};
}

TEST(FaultsOfMatrix, ACamerasMatrixHasNone) {
  EXPECT_THAT(faults_of_matrix(640, 480, kGood), IsEmpty());
  EXPECT_EQ(camera_of_matrix(640, 480, kGood).cy_px, 240.0);
}

TEST(FaultsOfMatrix, SayTheNumbersThatNoCameraHas) {
  const auto faults = [](const Matrix& k) { return faults_of_matrix(640, 480, k); };
  EXPECT_THAT(faults(with({{2, 1320.0}})),
              ElementsAre(HasSubstr("cx is 1320 px, within the image's 640 px expected")));
  EXPECT_THAT(faults(with({{5, -3.0}})),
              ElementsAre(HasSubstr("cy is -3 px, within the image's 480 px expected")));
  EXPECT_THAT(faults({520.0, 0.0, 0.0, 0.0, 520.0, 0.0, 320.0, 240.0, 1.0}),
              ElementsAre(HasSubstr("transposed")));
  EXPECT_THAT(faults(with({{6, 5.0}, {7, 5.0}, {8, 5.0}})),
              ElementsAre(HasSubstr("its last row is 5 5 5")));
  EXPECT_THAT(faults(with({{1, 37.0}, {3, 99.0}})), ElementsAre(HasSubstr("37 and 99")));
  EXPECT_THAT(faults(with({{0, 5200.0}})), ElementsAre(HasSubstr("nearly square")));
  EXPECT_THAT(faults(with({{0, -520.0}})), ElementsAre(HasSubstr("fx is -520 px")));
  EXPECT_THAT(faults(with({{4, std::nan("")}})), ElementsAre(HasSubstr("nan")));
  EXPECT_THAT(faults({}), ElementsAre(HasSubstr("not calibrated")));
}

TEST(FaultOfCamera, SaysAViewThatNoLensHas) {
  EXPECT_EQ(fault_of(camera(520.0)), "");
  EXPECT_NEAR(deg(camera(520.0).horizontal_view_rad()), 63.2, 0.1);
  EXPECT_THAT(fault_of(camera(52000.0)), HasSubstr("see 0.7052° from side to side"));
  EXPECT_THAT(fault_of(camera(10.0)), HasSubstr("3° to 170° expected"));
  // A fisheye sees more than half of all.
  EXPECT_EQ(fault_of(camera(180.0, "equidistant", {0.0, 0.0, 0.0, 0.0})), "");
  EXPECT_NEAR(camera(160.0, "equidistant", {0.0, 0.0, 0.0, 0.0}).horizontal_view_rad(), 4.0, 1e-9);
}

TEST(FaultOfCamera, SaysWhereTheDistortionFolds) {
  EXPECT_EQ(fault_of(camera(520.0, "plumb_bob", {-0.35, 0.12, 0.0, 0.0, 0.0})), "");
  EXPECT_THAT(fault_of(camera(300.0, "plumb_bob", {-0.9, 0.0, 0.0, 0.0, 0.0})),
              HasSubstr("folds the image over"));
}

}  // namespace
}  // namespace foretrack
