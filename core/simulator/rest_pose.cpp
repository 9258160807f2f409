// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/rest_pose.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace foretrack {
namespace {

using Vec3f = Eigen::Vector3f;

float facing_rad(const Skeleton::Side& side) {
  return std::atan2(side[1].x() - side[0].x(), side[0].y() - side[1].y());
}

struct Unwinding {
  Vec3f hips, neck;
  float hips_yaw, neck_yaw;

  explicit Unwinding(const Skeleton& s)
      : hips(0.5F * (s.hip[0] + s.hip[1])),
        neck(0.5F * (s.shoulder[0] + s.shoulder[1])),
        hips_yaw(facing_rad(s.hip)),
        neck_yaw(facing_rad(s.shoulder)) {}

  float share_at(float z) const {
    return std::clamp((z - hips.z()) / (neck.z() - hips.z()), 0.0F, 1.0F);
  }
  Eigen::Matrix3f turn_at(float share) const {
    const float yaw = hips_yaw + share * (neck_yaw - hips_yaw);
    return Eigen::AngleAxisf(-yaw, Vec3f::UnitZ()).toRotationMatrix();
  }
  void apply(Vec3f& position) const {
    const float share = share_at(position.z());
    const Vec3f spine = hips + share * (neck - hips);
    position = spine + turn_at(share) * (position - spine);
  }
};

// Disjoint sets of vertices.
struct Groups {
  std::vector<int> parent;
  explicit Groups(std::size_t count) : parent(count) { std::iota(parent.begin(), parent.end(), 0); }
  int of(int vertex) {
    while (parent[vertex] != vertex) vertex = parent[vertex] = parent[parent[vertex]];
    return vertex;
  }
  void join(int a, int b) { parent[of(a)] = of(b); }
};

// How much nearer to the right lower leg than to the left one.
float nearer_right(const Skeleton& s, const Vec3f& p) {
  std::array<float, 2> distance{};
  for (const int i : {0, 1})
    distance[i] = std::min(distance_to_segment(p, s.knee[i], s.ankle[i]),
                           distance_to_segment(p, s.ankle[i], s.toes[i]));
  return distance[0] - distance[1];
}

}  // namespace

float distance_to_segment(const Vec3f& p, const Vec3f& from, const Vec3f& to) {
  const Vec3f axis = to - from;
  const float along = std::clamp((p - from).dot(axis) / axis.squaredNorm(), 0.0F, 1.0F);
  return (p - from - along * axis).norm();
}

void unwind(PersonMesh& mesh, Skeleton& s) {
  const Unwinding unwinding(s);
  for (auto& v : mesh.vertices) {
    v.normal = unwinding.turn_at(unwinding.share_at(v.position.z())) * v.normal;
    unwinding.apply(v.position);
  }
  for (auto* side :
       {&s.shoulder, &s.elbow, &s.wrist, &s.fingertips, &s.hip, &s.knee, &s.ankle, &s.toes})
    for (Vec3f& joint : *side) unwinding.apply(joint);
}

std::vector<int> leg_of_each_vertex(const PersonMesh& mesh, const Skeleton& s) {
  const float knees_z = std::min(s.knee[0].z(), s.knee[1].z());
  const float middle = 0.5F * (s.knee[0].y() + s.knee[1].y());
  const auto is_low = [&](int v) { return mesh.vertices[v].position.z() < knees_z; };
  Groups groups(mesh.vertices.size());
  for (const auto& [v, texture] : mesh.triangles)
    for (const auto& [a, b] : {std::pair{v[0], v[1]}, {v[1], v[2]}})
      if (is_low(a) && is_low(b)) groups.join(a, b);
  std::vector<float> votes(mesh.vertices.size(), 0.0F);
  const auto count = static_cast<int>(mesh.vertices.size());
  for (int v = 0; v < count; ++v) votes[groups.of(v)] += nearer_right(s, mesh.vertices[v].position);
  std::vector<int> legs(mesh.vertices.size());
  for (int v = 0; v < count; ++v)
    legs[v] = is_low(v) ? votes[groups.of(v)] > 0.0F : mesh.vertices[v].position.y() < middle;
  return legs;
}

}  // namespace foretrack
