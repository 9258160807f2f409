// SPDX-License-Identifier: Apache-2.0
// What a lens does to image points, undone: the poses assume a camera without distortion.
#pragma once

#include <Eigen/LU>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/common/camera.hpp"
#include "core/perception/find_landmarks.hpp"

namespace foretrack {

/// Names and order of the coefficients are those of ROS and OpenCV.
struct Lens {
  enum class Model : std::uint8_t {
    kPlumbBob,            // k1 k2 p1 p2 k3
    kRationalPolynomial,  // k1 k2 p1 p2 k3 k4 k5 k6
    kEquidistant,         // k1 k2 k3 k4, of the angle (fisheye)
  };
  Model model = Model::kPlumbBob;
  std::array<double, 8> coefficients{};
  bool distorts() const;
};

/// The lens of a distortion model by ROS' name; an empty name without coefficients: none. Throws
/// std::invalid_argument that says what was expected.
Lens lens_of(std::string_view model, std::span<const double> coefficients);

/// Where an image point would be without the lens' distortion; none where the model cannot be
/// inverted (far outside the image). Cost: 1 µs.
std::optional<Vec2> undistort(const Vec2& image_px, const CameraModel& camera, const Lens& lens);
/// The opposite: what the lens makes of a point in front of the camera (z = 1).
Vec2 distort(const Vec2& ray, const CameraModel& camera, const Lens& lens);

/// All landmarks; those that cannot be undistorted become invisible.
void undistort(PersonPose& person, const CameraModel& camera, const Lens& lens);

}  // namespace foretrack
