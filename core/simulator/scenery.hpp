// SPDX-License-Identifier: Apache-2.0
// A world as textured surfaces in the daylight.
#pragma once

#include <array>
#include <vector>

#include "core/simulator/rasterizer.hpp"
#include "core/simulator/world.hpp"

namespace foretrack {

/// Unit vector to the sun.
Eigen::Vector3f sun_direction();

/// Light that falls on a surface of this unit normal (world): the sun's and the sky's.
float daylight(const Eigen::Vector3f& normal_enu);

/// Flat and convex, in the world, counter-clockwise from outside.
struct Face {
  std::array<Corner, 4> corners;  // camera_m holds the place in the world
  Surface surface = Surface::kPaving;
};

struct Scenery {
  std::array<Texture, kSurfaceCount> textures;
  std::vector<Face> faces;
};

/// The ground (far beyond the bounds), the boxes, and the cylinders with 24 sides. High boxes are
/// houses and walls, low ones hedges; which surface is decided by the shape's place in the list.
Scenery build_scenery(const World& world);

/// Draws what the camera may see.
void draw(Canvas& canvas, const Scenery& scenery, const Eigen::Isometry3f& T_camera_world);

}  // namespace foretrack
