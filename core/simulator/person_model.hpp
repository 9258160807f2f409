// SPDX-License-Identifier: Apache-2.0
// A textured person whose limbs follow the joints of the simulated one.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/simulator/body.hpp"
#include "core/simulator/rasterizer.hpp"

namespace foretrack {

/// A mesh as modelled: forward along x, left along y, up along z, in any unit.
struct PersonMesh {
  /// A corner of triangles; u and v are places in the texture.
  struct Vertex {
    Eigen::Vector3f position = Eigen::Vector3f::Zero();
    Eigen::Vector3f normal = Eigen::Vector3f::UnitX();
    float u = 0.0F, v = 0.0F;
  };
  /// Indices into vertices and textures.
  struct Triangle {
    std::array<int, 3> vertices{};  ///< counter-clockwise from outside
    int texture = 0;
  };
  std::vector<Vertex> vertices;
  std::vector<Triangle> triangles;
  std::vector<Texture> textures;
};

/// Where the joints are in a mesh of height 1 with its feet at z = 0 and its middle at x = y = 0.
struct Skeleton {
  using Side = std::array<Eigen::Vector3f, 2>;  ///< left, right
  Side shoulder, elbow, wrist, fingertips;
  Side hip, knee, ankle, toes;
  bool arms_swing = true;  ///< false: they are crossed or rest on the body, and move with the torso
};

/// Parts that move as one: torso, head; then for each side upper arm, forearm, thigh, shank, foot.
inline constexpr int kBoneCount = 12;

/// A mesh that can be posed.
struct PersonModel {
  PersonMesh mesh;    ///< brought to height 1
  Skeleton skeleton;  ///< in that mesh
  /// The two bones that a vertex follows.
  struct Skin {
    std::array<int, 2> bones{};
    float first_weight = 1.0F;  ///< of bones[0]; the rest is that of bones[1]
  };
  std::vector<Skin> skin;  ///< of each vertex
};

/// Brings the mesh to height 1, turns hips and shoulders ahead, and binds each vertex to its two
/// nearest bones. Throws std::invalid_argument for a mesh without triangles or with indices out of
/// range.
PersonModel make_person_model(PersonMesh mesh, Skeleton skeleton);

/// Fills `posed` with the model's vertices in the world, lit, so that its joints are where
/// `joints_enu_m` has them. Limbs are turned, and stretched along themselves; between two bones the
/// skin is blended (linear blend skinning). Reuses the memory of `posed`.
void pose_person(const PersonModel& model, const std::array<Vec3, kLandmarkCount>& joints_enu_m,
                 double height_m, std::vector<Corner>& posed);

/// Fills `shadow` with the places on the ground where the sun's shadow of the posed vertices falls,
/// textured as the ground is. Reuses its memory.
void cast_shadow(std::span<const Corner> posed, double ground_z_m, std::vector<Corner>& shadow);

/// Draws a posed person, or their shadow, whose corners are in the camera's frame. Cost: about 1.5
/// ms for 10 000 triangles.
void draw(Canvas& canvas, const PersonModel& model, std::span<const Corner> posed);
/// Draws the outline of the person's shadow on the ground.
void draw_shadow(Canvas& canvas, const PersonModel& model, std::span<const Corner> shadow,
                 const Texture& ground);

}  // namespace foretrack
