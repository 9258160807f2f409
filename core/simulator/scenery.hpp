// SPDX-License-Identifier: Apache-2.0
// A world as textured surfaces in the daylight.
#pragma once

#include <array>
#include <vector>

#include "core/simulator/rasterizer.hpp"
#include "core/simulator/world.hpp"

namespace foretrack {

/// Unit vector towards the sun, world ENU.
Eigen::Vector3f sun_direction();

/// The light that falls on a surface of this unit normal (world ENU), from the sun and from the
/// sky, by which its colour is multiplied. There are no shadows but those of people.
float daylight(const Eigen::Vector3f& normal_enu);

/// A flat and convex part of a surface.
struct Face {
  /// Counter-clockwise from outside. Their camera_m holds the place in the world.
  std::array<Corner, 4> corners;
  Surface surface = Surface::kPaving;
};

/// A world that can be drawn.
struct Scenery {
  std::array<Texture, kSurfaceCount> textures;  ///< of each Surface
  std::vector<Face> faces;
};

/// The scenery of a world: the ground (far beyond the bounds), the boxes, and the cylinders with 24
/// sides. Boxes lower than 1.6 m are hedges, others houses and walls; what a wall is made of
/// follows from the box's place in the list. Cost: 20 ms, most of it for the textures.
Scenery build_scenery(const World& world);

/// Draws the faces that look towards the camera.
void draw(Canvas& canvas, const Scenery& scenery, const Eigen::Isometry3f& T_camera_world);

}  // namespace foretrack
