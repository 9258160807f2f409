// SPDX-License-Identifier: Apache-2.0
// Perspective-correct texture coordinates, the mip level by their change from pixel to pixel,
// bilinear texels, light.
#include "core/simulator/shade.hpp"

#include <algorithm>
#include <bit>

namespace foretrack {
namespace {

constexpr std::uint32_t kRedBlue = 0x00ff00ff, kGreen = 0x0000ff00;
constexpr float kZenith[3] = {96.0F, 146.0F, 208.0F}, kHorizon[3] = {206.0F, 216.0F, 224.0F};

// Between a (0) and b (256).
std::uint32_t mix(std::uint32_t a, std::uint32_t b, std::uint32_t weight) {
  const std::uint32_t red_blue =
      ((a & kRedBlue) * (256 - weight) + (b & kRedBlue) * weight) >> 8 & kRedBlue;
  const std::uint32_t green = ((a & kGreen) * (256 - weight) + (b & kGreen) * weight) >> 8 & kGreen;
  return red_blue | green;
}

// floor(log2(x)) of a positive normal number.
int floor_log2(float x) {
  return static_cast<int>(std::bit_cast<std::uint32_t>(x) >> 23) - 127;
}

std::uint32_t sample(const Texture& texture, float u, float v, float spread) {
  const Texture::Level& finest = texture.levels.front();
  const int coarsest = static_cast<int>(texture.levels.size()) - 1;
  const float side = static_cast<float>(1 << std::max(finest.width_log2, finest.height_log2));
  const int wanted = (floor_log2(spread * side * side + 1e-20F) + 1) / 2;
  const Texture::Level& level = texture.levels[std::clamp(wanted, 0, coarsest)];
  const int mask_x = (1 << level.width_log2) - 1, mask_y = (1 << level.height_log2) - 1;
  const float x = (u - std::floor(u)) * static_cast<float>(mask_x + 1) - 0.5F;
  const float y = (v - std::floor(v)) * static_cast<float>(mask_y + 1) - 0.5F;
  const int fixed_x = static_cast<int>(256.0F * (x + 1.0F)) - 256;
  const int fixed_y = static_cast<int>(256.0F * (y + 1.0F)) - 256;
  const int i = fixed_x >> 8, j = fixed_y >> 8;
  const std::uint32_t* texels = texture.texels.data() + level.first;
  const std::uint32_t* row = texels + ((j & mask_y) << level.width_log2);
  const std::uint32_t* next = texels + (((j + 1) & mask_y) << level.width_log2);
  const int left = i & mask_x, right = (i + 1) & mask_x;
  const auto along = static_cast<std::uint32_t>(fixed_x & 255);
  return mix(mix(row[left], row[right], along), mix(next[left], next[right], along),
             static_cast<std::uint32_t>(fixed_y & 255));
}

float at(const ScreenPlane& plane, int x, int y) {
  return plane.a * static_cast<float>(x) + plane.b * static_cast<float>(y) + plane.c;
}

void shade_run(const Facet& facet, int row, int begin, int end, const float* inverse_depth,
               std::uint8_t* rgb) {
  const ScreenPlane &z = facet.inverse_depth, &pu = facet.u, &pv = facet.v;
  for (int x = begin; x < end; ++x, rgb += 3) {
    const float depth = 1.0F / inverse_depth[x];
    const float u = at(pu, x, row) * depth, v = at(pv, x, row) * depth;
    const float ux = pu.a - u * z.a, vx = pv.a - v * z.a, uy = pu.b - u * z.b, vy = pv.b - v * z.b;
    const float spread = std::max(ux * ux + vx * vx, uy * uy + vy * vy) * depth * depth;
    const std::uint32_t texel = sample(*facet.texture, u, v, spread);
    const auto light = static_cast<std::uint32_t>(
        256.0F * std::clamp(at(facet.light, x, row) * depth, 0.0F, 2.0F));
    rgb[0] = static_cast<std::uint8_t>(std::min((texel & 0xff) * light >> 8, 255U));
    rgb[1] = static_cast<std::uint8_t>(std::min((texel >> 8 & 0xff) * light >> 8, 255U));
    rgb[2] = static_cast<std::uint8_t>(std::min((texel >> 16 & 0xff) * light >> 8, 255U));
  }
}

// Lighter towards the horizon. `height`: the ray's rise over its depth, linear along the row.
void shade_sky(float height, float slope, int begin, int end, std::uint8_t* rgb) {
  for (int x = begin; x < end; ++x, rgb += 3) {
    const float rise = std::clamp(1.4F * (height + slope * static_cast<float>(x)), 0.0F, 1.0F);
    for (int i = 0; i < 3; ++i)
      rgb[i] = static_cast<std::uint8_t>(kHorizon[i] + rise * (kZenith[i] - kHorizon[i]));
  }
}

}  // namespace

void shade(Canvas& canvas, const Sky& sky) {
  const CameraModel& c = canvas.camera;
  const Vec3 up = sky.up_camera.cast<double>();
  for (int y = 0; y < c.height_px; ++y) {
    const std::size_t first = static_cast<std::size_t>(y) * c.width_px;
    const std::int32_t* facet = &canvas.facet[first];
    const double rise =
        up.x() * (0.5 - c.cx_px) / c.fx_px + up.y() * (y + 0.5 - c.cy_px) / c.fy_px + up.z();
    for (int begin = 0, end = 0; begin < c.width_px; begin = end) {
      const std::int32_t id = facet[begin];
      while (end < c.width_px && facet[end] == id) ++end;
      std::uint8_t* rgb = canvas.color.pixel(begin, y);
      if (id < 0)
        shade_sky(static_cast<float>(rise), static_cast<float>(up.x() / c.fx_px), begin, end, rgb);
      else
        shade_run(canvas.facets[id], y, begin, end, &canvas.inverse_depth[first], rgb);
    }
  }
}

}  // namespace foretrack
