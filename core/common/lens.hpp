// SPDX-License-Identifier: Apache-2.0
// Lenses that distort. Poses are worked out for a camera without distortion (CameraModel), so what
// the lens did to the image points is undone first.
#pragma once

#include <Eigen/LU>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/common/camera.hpp"

namespace foretrack {

/// How a lens bends rays. Models, names and order of the coefficients are those of ROS
/// (sensor_msgs/CameraInfo) and OpenCV; coefficients have no unit. By default: no distortion.
struct Lens {
  enum class Model : std::uint8_t {
    kPlumbBob,            // k1 k2 p1 p2 k3
    kRationalPolynomial,  // k1 k2 p1 p2 k3 k4 k5 k6
    kEquidistant,         // k1 k2 k3 k4, of the angle (fisheye)
  };
  Model model = Model::kPlumbBob;
  std::array<double, 8> coefficients{};
  /// False if the lens leaves every image point where it is.
  bool distorts() const;
};

/// The lens of a distortion model by its name in ROS: plumb_bob (4 or 5 coefficients; 8 are those
/// of a rational_polynomial, as OpenCV has it), rational_polynomial (8; 12 or 14 if those of the
/// thin prism and the tilt are 0), equidistant or fisheye (4). An empty name or "none" is a lens
/// that does not distort; its coefficients, if there are any, must be 0. Throws
/// std::invalid_argument that says what was expected: another name, another number of coefficients,
/// or one that is not finite.
Lens lens_of(std::string_view model, std::span<const double> coefficients);

/// Where an image point would be without the lens' distortion, by Newton's method. None where the
/// model cannot be inverted, far outside the image. Cost: 1 µs.
std::optional<Vec2> undistort(const Vec2& image_px, const CameraModel& camera, const Lens& lens);
/// The opposite: the image point that the lens makes of a ray, given by its x and y at z = 1 in the
/// optical frame.
Vec2 distort(const Vec2& ray, const CameraModel& camera, const Lens& lens);

}  // namespace foretrack
