// SPDX-License-Identifier: Apache-2.0
// A person of boxes, one a bone, to be rendered where no textured people are installed.
#pragma once

#include <memory>

#include "core/simulator/person_model.hpp"

namespace foretrack::testing {

/// Standing as the simulated person does.
inline Skeleton standing_skeleton() {
  PersonState standing;
  standing.position_enu_m.z() = torso_height_m(1.0);
  const auto joints = joints_enu_m(standing, 1.0);
  const auto side = [&](int left) {
    return Skeleton::Side{joints[left].cast<float>(), joints[left + 1].cast<float>()};
  };
  return {side(11), side(13), side(15), side(19), side(23), side(25), side(27), side(31)};
}

/// Somebody of 1.7 m who walks at 1.4 m/s, at a place 3 m ahead of the origin.
inline PersonState walking(double yaw_rad, double stride_rad) {
  PersonState person;
  person.position_enu_m = {3.0, 0.5, torso_height_m(1.7)};
  person.velocity_enu_m_s.head<2>() = 1.4 * direction_of(yaw_rad);
  person.body_yaw_rad = yaw_rad;
  person.stride_rad = stride_rad;
  return person;
}

/// A box around a segment.
inline void add_bone(PersonMesh& mesh, const Eigen::Vector3f& from, const Eigen::Vector3f& to,
                     float half, int texture) {
  const int first = static_cast<int>(mesh.vertices.size());
  const Eigen::Vector3f low = from.cwiseMin(to).array() - half;
  const Eigen::Vector3f high = from.cwiseMax(to).array() + half;
  for (int i = 0; i < 8; ++i) {
    PersonMesh::Vertex& v = mesh.vertices.emplace_back();
    v.position = {i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(),
                  i & 4 ? high.z() : low.z()};
    v.normal = (v.position - 0.5F * (from + to)).normalized();
  }
  constexpr int kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : kFaces) {
    mesh.triangles.push_back({{first + f[0], first + f[1], first + f[2]}, texture});
    mesh.triangles.push_back({{first + f[0], first + f[2], first + f[3]}, texture});
  }
}

inline std::shared_ptr<const PersonModel> make_mannequin() {
  const Skeleton s = standing_skeleton();
  PersonMesh mesh;
  mesh.textures = {make_texture({1, 1, {230, 40, 40}})};
  const Eigen::Vector3f neck = 0.5F * (s.shoulder[0] + s.shoulder[1]);
  add_bone(mesh, s.hip[1], s.shoulder[0], 0.03F, 0);
  add_bone(mesh, neck, Eigen::Vector3f(0.0F, 0.0F, 0.96F), 0.04F, 0);
  for (int i = 0; i < 2; ++i) {
    add_bone(mesh, s.shoulder[i], s.elbow[i], 0.02F, 0);
    add_bone(mesh, s.elbow[i], s.wrist[i], 0.02F, 0);
    add_bone(mesh, s.hip[i], s.knee[i], 0.03F, 0);
    add_bone(mesh, s.knee[i], s.ankle[i], 0.03F, 0);
    add_bone(mesh, s.ankle[i], s.toes[i], 0.015F, 0);
  }
  return std::make_shared<PersonModel>(make_person_model(std::move(mesh), s));
}

}  // namespace foretrack::testing
