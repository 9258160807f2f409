// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/rasterizer.hpp"

#include <algorithm>

namespace foretrack {
namespace {

constexpr double kNearPlane_m = 0.05;
constexpr std::size_t kMaxCorners = 8;

// The part of a polygon in front of the camera, in the image.
struct Outline {
  std::array<Vec2, kMaxCorners + 1> px;
  std::size_t count = 0;
};

Outline clip(const CameraModel& camera, std::span<const Corner> polygon) {
  Outline outline;
  const auto add = [&](const Vec3& p) {
    outline.px[outline.count++] = {camera.fx_px * p.x() / p.z() + camera.cx_px,
                                   camera.fy_px * p.y() / p.z() + camera.cy_px};
  };
  Vec3 last = polygon.back().camera_m.cast<double>();
  for (const Corner& corner : polygon) {
    const Vec3 p = corner.camera_m.cast<double>();
    const bool in = p.z() >= kNearPlane_m;
    if (in != (last.z() >= kNearPlane_m)) {
      // From the nearer end, so that neighbours cut their common edge at the same point.
      const Vec3 &a = in ? p : last, &b = in ? last : p;
      Vec3 cut = a + (a.z() - kNearPlane_m) / (a.z() - b.z()) * (b - a);
      cut.z() = kNearPlane_m;
      add(cut);
    }
    if (in) add(p);
    last = p;
  }
  return outline;
}

// An attribute over the depth is linear in the image, k·ray, where k·P is the attribute at each of
// the three corners P.
ScreenPlane plane_of(const CameraModel& c, const Vec3& k) {
  const double a = k.x() / c.fx_px, b = k.y() / c.fy_px;
  const double at_first = k.z() + a * (0.5 - c.cx_px) + b * (0.5 - c.cy_px);
  return {static_cast<float>(a), static_cast<float>(b), static_cast<float>(at_first)};
}

// The nearest surface so far wins; written so that compilers vectorise it.
void fill_span(float* inverse_depth, std::int32_t* facet, int count, float first, float slope,
               std::int32_t id) {
  for (int i = 0; i < count; ++i) {
    const float z = first + slope * static_cast<float>(i);
    const bool nearer = z > inverse_depth[i];
    inverse_depth[i] = nearer ? z : inverse_depth[i];
    facet[i] = nearer ? id : facet[i];
  }
}

// First pixel whose centre is at or beyond x.
int first_pixel(double x, int limit) {
  return static_cast<int>(std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(limit)));
}

// Where a row's centre crosses an edge; always reckoned from the edge's upper end, so that
// neighbours leave neither gaps nor overlaps.
double crossing(Vec2 a, Vec2 b, double y) {
  if (a.y() > b.y()) std::swap(a, b);
  return a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
}

void fill(Canvas& canvas, const Outline& outline, const ScreenPlane& z, std::int32_t id) {
  const int width = canvas.camera.width_px, height = canvas.camera.height_px;
  double top = outline.px[0].y(), bottom = top;
  for (std::size_t i = 1; i < outline.count; ++i) {
    top = std::min(top, outline.px[i].y());
    bottom = std::max(bottom, outline.px[i].y());
  }
  const int end = first_pixel(bottom, height);
  for (int y = first_pixel(top, height); y < end; ++y) {
    double left = 1e30, right = -1e30;
    for (std::size_t i = 0; i < outline.count; ++i) {
      const Vec2 &a = outline.px[i], &b = outline.px[i + 1 < outline.count ? i + 1 : 0];
      if ((a.y() <= y + 0.5) == (b.y() <= y + 0.5)) continue;
      const double x = crossing(a, b, y + 0.5);
      left = std::min(left, x);
      right = std::max(right, x);
    }
    const int x0 = first_pixel(left, width), x1 = first_pixel(right, width);
    if (x0 >= x1) continue;
    const std::size_t at = static_cast<std::size_t>(y) * width + x0;
    const float first = z.a * static_cast<float>(x0) + z.b * static_cast<float>(y) + z.c;
    fill_span(&canvas.inverse_depth[at], &canvas.facet[at], x1 - x0, first, z.a, id);
  }
}

}  // namespace

Canvas make_canvas(const CameraModel& camera) {
  const auto pixels = static_cast<std::size_t>(camera.width_px) * camera.height_px;
  Canvas canvas{.camera = camera,
                .color = {camera.width_px, camera.height_px, std::vector<std::uint8_t>(3 * pixels)},
                .inverse_depth = std::vector<float>(pixels),
                .facet = std::vector<std::int32_t>(pixels),
                .facets = {}};
  clear(canvas);
  return canvas;
}

void clear(Canvas& canvas) {
  std::fill(canvas.inverse_depth.begin(), canvas.inverse_depth.end(), 0.0F);
  std::fill(canvas.facet.begin(), canvas.facet.end(), -1);
  canvas.facets.clear();
}

void draw(Canvas& canvas, std::span<const Corner> polygon, const Texture& texture) {
  const Corner &p = polygon[0], &q = polygon[1], &r = polygon[2];
  const Vec3 a = p.camera_m.cast<double>(), b = q.camera_m.cast<double>(),
             c = r.camera_m.cast<double>();
  const Vec3 bc = b.cross(c);
  const double volume = a.dot(bc);
  if (!(volume < -1e-12)) return;  // seen from behind or from the edge
  const Outline outline = clip(canvas.camera, polygon);
  if (outline.count < 3) return;
  const Vec3 ka = bc / volume, kb = c.cross(a) / volume, kc = a.cross(b) / volume;
  const auto plane = [&](double at_a, double at_b, double at_c) {
    return plane_of(canvas.camera, at_a * ka + at_b * kb + at_c * kc);
  };
  canvas.facets.push_back({plane(1.0, 1.0, 1.0), plane(p.u, q.u, r.u), plane(p.v, q.v, r.v),
                           plane(p.light, q.light, r.light), &texture});
  fill(canvas, outline, canvas.facets.back().inverse_depth,
       static_cast<std::int32_t>(canvas.facets.size()) - 1);
}

}  // namespace foretrack
