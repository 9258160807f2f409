// SPDX-License-Identifier: Apache-2.0
#include "core/common/calibrated_camera.hpp"

#include <cmath>
#include <sstream>

namespace foretrack {
namespace {

constexpr double kMostFocal_px = 1e5;
constexpr double kMostSkew = 1e-3;   // of the focal length
constexpr double kMostAspect = 3.0;  // of a pixel
constexpr double kLeastView_deg = 3.0, kMostView_deg = 170.0, kMostFisheyeView_deg = 280.0;

template <class... Words>
std::string words(const Words&... parts) {
  std::ostringstream text;
  text.precision(4);
  (text << ... << parts);
  return text.str();
}

double view_rad(double side_px, double focal_px, const Lens& lens) {
  return lens.model == Lens::Model::kEquidistant ? side_px / focal_px
                                                 : 2.0 * std::atan(0.5 * side_px / focal_px);
}

std::string fault_of_view(const char* where, double view_rad, bool fisheye) {
  const double view_deg = deg(view_rad);
  const double most_deg = fisheye ? kMostFisheyeView_deg : kMostView_deg;
  if (view_deg >= kLeastView_deg && view_deg <= most_deg) return "";
  return words("the camera would see ", view_deg, "° ", where, "; ", kLeastView_deg, "° to ",
               most_deg, "° expected: are focal length and image size of the same image?");
}

}  // namespace

double CameraWithLens::horizontal_view_rad() const {
  return view_rad(camera.width_px, camera.fx_px, lens);
}
double CameraWithLens::vertical_view_rad() const {
  return view_rad(camera.height_px, camera.fy_px, lens);
}

std::vector<std::string> faults_of_matrix(int width_px, int height_px,
                                          const std::array<double, 9>& k) {
  constexpr const char* kExpected = "; fx 0 cx, 0 fy cy, 0 0 1 in pixels expected";
  std::vector<std::string> faults;
  for (const double value : k)
    if (!std::isfinite(value)) return {words(value, " is in it", kExpected)};
  if (k == std::array<double, 9>{})
    return {"all zeros, as of a camera that is not calibrated; its matrix expected"};
  if (k[6] > 1.0 && k[7] > 1.0 && k[2] == 0.0 && k[5] == 0.0)
    return {
        words("cx ", k[6], " and cy ", k[7], " are in its last row: it is transposed", kExpected)};
  for (const int i : {0, 4})
    if (!(k[i] > 0.0 && k[i] < kMostFocal_px))
      faults.push_back(words(i == 0 ? "fx" : "fy", " is ", k[i], " px, above 0 expected"));
  if (!faults.empty()) return faults;
  if (k[6] != 0.0 || k[7] != 0.0 || k[8] != 1.0)
    faults.push_back(words("its last row is ", k[6], " ", k[7], " ", k[8], kExpected));
  if (std::abs(k[1]) > kMostSkew * k[0] || std::abs(k[3]) > kMostSkew * k[4])
    faults.push_back(words("beside fx and fy stand ", k[1], " and ", k[3], kExpected));
  if (k[0] > kMostAspect * k[4] || k[4] > kMostAspect * k[0])
    faults.push_back(words("fx is ", k[0], " and fy ", k[4],
                           " px; nearly the same expected, as pixels are nearly square"));
  if (!(k[2] > 0.0 && k[2] < width_px))
    faults.push_back(words("cx is ", k[2], " px, within the image's ", width_px, " px expected"));
  if (!(k[5] > 0.0 && k[5] < height_px))
    faults.push_back(words("cy is ", k[5], " px, within the image's ", height_px, " px expected"));
  return faults;
}

CameraModel camera_of_matrix(int width_px, int height_px, const std::array<double, 9>& k) {
  CameraModel camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.fx_px = k[0];
  camera.cx_px = k[2];
  camera.fy_px = k[4];
  camera.cy_px = k[5];
  return camera;
}

std::string fault_of(const CameraWithLens& c) {
  const bool fisheye = c.lens.model == Lens::Model::kEquidistant;
  std::string fault = fault_of_view("from side to side", c.horizontal_view_rad(), fisheye);
  if (fault.empty()) fault = fault_of_view("from top to bottom", c.vertical_view_rad(), fisheye);
  if (!fault.empty()) return fault;
  const double width = c.camera.width_px, height = c.camera.height_px;
  for (const Vec2& side : {Vec2(0.0, c.camera.cy_px), Vec2(width, c.camera.cy_px),
                           Vec2(c.camera.cx_px, 0.0), Vec2(c.camera.cx_px, height)})
    if (!undistort(side, c.camera, c.lens) && !fisheye)
      return words("no ray goes to (", side.x(), ", ", side.y(),
                   ") px: the distortion folds the image over; are the coefficients of this "
                   "camera, in the order of its model?");
  return "";
}

}  // namespace foretrack
