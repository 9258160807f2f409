// SPDX-License-Identifier: Apache-2.0
// A z-buffer: convex polygons in, what each pixel shows and its depth out; shade.hpp fills in the
// colours.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/common/camera.hpp"
#include "core/common/image.hpp"
#include "core/simulator/texture.hpp"

namespace foretrack {

/// A corner of a polygon. Texture coordinates count repeats; light multiplies the texture's colour.
struct Corner {
  Eigen::Vector3f camera_m = Eigen::Vector3f::Zero();  ///< optical frame
  float u = 0.0F, v = 0.0F;
  float light = 1.0F;
};

/// a·x + b·y + c at the centre of pixel (x, y): what is linear in the image (a quantity over
/// depth).
struct ScreenPlane {
  float a = 0.0F, b = 0.0F, c = 0.0F;
};

/// A drawn polygon: everything about it but its outline.
struct Facet {
  ScreenPlane inverse_depth;  ///< 1/m
  ScreenPlane u, v, light;    ///< each divided by the depth
  const Texture* texture = nullptr;
};

/// An image that is being drawn.
struct Canvas {
  CameraModel camera;
  RgbImage color;
  std::vector<float> inverse_depth;  ///< of each pixel, 1/m along the optical axis; 0: sky
  std::vector<std::int32_t> facet;   ///< index of the facet that each pixel shows; −1: sky
  std::vector<Facet> facets;         ///< of this image
};
/// A canvas of the camera's size with nothing but sky.
Canvas make_canvas(const CameraModel& camera);

/// Leaves nothing but sky.
void clear(Canvas& canvas);

/// Draws a flat convex polygon of three to eight corners, which run counter-clockwise as seen from
/// outside. From behind it is not drawn. Parts nearer than 5 cm are cut off. The texture must
/// outlive shade().
void draw(Canvas& canvas, std::span<const Corner> polygon, const Texture& texture);

}  // namespace foretrack
