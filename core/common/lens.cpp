// SPDX-License-Identifier: Apache-2.0
#include "core/common/lens.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace foretrack {
namespace {

constexpr int kIterations = 25;
constexpr double kConverged = 1e-9;   // of z = 1
constexpr double kWidest_rad = 1.55;  // beyond it a ray has no image point
constexpr double kStep = 1e-6;
constexpr double kMostCoefficient = 1e4;

// Image plane at z = 1, without distortion → with it.
Vec2 bend(const Vec2& ray, const Lens& lens) {
  const auto& k = lens.coefficients;
  const double r2 = ray.squaredNorm();
  if (lens.model == Lens::Model::kEquidistant) {
    const double r = std::sqrt(r2);
    if (r < 1e-12) return ray;
    const double a = std::atan(r), a2 = a * a;
    return ray * (a * (1.0 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3])))) / r);
  }
  const double above = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const bool rational = lens.model == Lens::Model::kRationalPolynomial;
  const double below = rational ? 1.0 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])) : 1.0;
  const double xy = ray.x() * ray.y();
  return ray * (above / below) + Vec2(2.0 * k[2] * xy + k[3] * (r2 + 2.0 * ray.x() * ray.x()),
                                      k[2] * (r2 + 2.0 * ray.y() * ray.y()) + 2.0 * k[3] * xy);
}

Mat2 derivative(const Vec2& ray, const Lens& lens) {
  Mat2 d;
  for (int axis = 0; axis < 2; ++axis) {
    Vec2 step = Vec2::Zero();
    step[axis] = kStep;
    d.col(axis) = (bend(ray + step, lens) - bend(ray - step, lens)) / (2.0 * kStep);
  }
  return d;
}

}  // namespace

Lens lens_of(std::string_view model, std::span<const double> coefficients) {
  for (std::size_t k = 0; k < coefficients.size(); ++k)
    if (!(std::abs(coefficients[k]) <= kMostCoefficient))
      throw std::invalid_argument("distortion coefficient " + std::to_string(k) +
                                  ": a finite number expected");
  const auto is_zero = [](double k) { return k == 0.0; };
  const bool straight = std::all_of(coefficients.begin(), coefficients.end(), is_zero);
  if (model == "none" && !straight)
    throw std::invalid_argument("distortion model 'none' has coefficients other than 0");
  if ((model.empty() || model == "none") && straight) return {};
  const std::size_t count = coefficients.size();
  const bool fisheye = model == "equidistant" || model == "fisheye";
  const bool polynomial = model == "rational_polynomial";
  if (!fisheye && !polynomial && !model.empty() && model != "plumb_bob")
    throw std::invalid_argument("distortion model '" + std::string(model.substr(0, 40)) +
                                "': plumb_bob, rational_polynomial, equidistant or none expected");
  if (model == "plumb_bob" && count == 0) return {};
  const auto refuse = [count](const char* expected) {
    throw std::invalid_argument(std::to_string(count) + " distortion coefficients: " + expected +
                                " expected");
  };
  if (fisheye && count != 4) refuse("4");
  if (polynomial && count != 8 && count != 12 && count != 14) refuse("8");
  if (!fisheye && !polynomial && count != 4 && count != 5 && count != 8) refuse("5");
  const std::size_t used = std::min<std::size_t>(count, 8);
  if (!std::all_of(coefficients.begin() + static_cast<std::ptrdiff_t>(used), coefficients.end(),
                   is_zero))
    throw std::invalid_argument(
        "distortion coefficients of a thin prism or a tilted sensor: 0 expected");
  Lens lens;
  if (fisheye) lens.model = Lens::Model::kEquidistant;
  if (!fisheye && used == 8) lens.model = Lens::Model::kRationalPolynomial;
  std::copy_n(coefficients.begin(), used, lens.coefficients.begin());
  return lens;
}

bool Lens::distorts() const {
  return std::any_of(coefficients.begin(), coefficients.end(), [](double k) { return k != 0.0; }) ||
         model == Model::kEquidistant;
}

Vec2 distort(const Vec2& ray, const CameraModel& camera, const Lens& lens) {
  const Vec2 bent = bend(ray, lens);
  return {camera.fx_px * bent.x() + camera.cx_px, camera.fy_px * bent.y() + camera.cy_px};
}

std::optional<Vec2> undistort(const Vec2& image_px, const CameraModel& camera, const Lens& lens) {
  if (!lens.distorts()) return image_px;
  const Vec2 bent((image_px.x() - camera.cx_px) / camera.fx_px,
                  (image_px.y() - camera.cy_px) / camera.fy_px);
  Vec2 ray = bent;
  if (lens.model == Lens::Model::kEquidistant && bent.norm() > 1e-12)
    ray *= std::tan(std::min(bent.norm(), 1.4)) / bent.norm();
  for (int k = 0; k < kIterations; ++k) {
    const Vec2 miss = bend(ray, lens) - bent;
    if (!miss.allFinite()) return std::nullopt;
    if (miss.norm() < kConverged) {
      const Mat2 d = derivative(ray, lens);
      // Past the fold of the polynomial the model is no lens any more.
      const bool folded = d.determinant() <= 0.0 || std::atan(ray.norm()) > kWidest_rad;
      if (folded) return std::nullopt;
      return Vec2(camera.fx_px * ray.x() + camera.cx_px, camera.fy_px * ray.y() + camera.cy_px);
    }
    const Mat2 d = derivative(ray, lens);
    if (std::abs(d.determinant()) < 1e-9) return std::nullopt;
    const Vec2 step = d.inverse() * miss;
    ray -= step * std::min(1.0, 0.5 / std::max(step.norm(), 1e-12));
  }
  return std::nullopt;
}

}  // namespace foretrack
