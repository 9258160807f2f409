// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/person_model.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "core/simulator/rest_pose.hpp"
#include "core/simulator/scenery.hpp"

namespace foretrack {
namespace {

using Vec3f = Eigen::Vector3f;
using Bend = Eigen::Transform<float, 3, Eigen::AffineCompact>;

enum Bone { kTorsoBone, kHead, kUpperArm, kForearm = 4, kThigh = 6, kShank = 8, kFoot = 10 };

// A bone as the skin sees it: all within the radius of the segment.
struct Capsule {
  int bone;
  Vec3f from, to;
  float radius;
};

constexpr float kOtherLeg = 0.1F;        // farther than anything of the own leg
constexpr float kShadowLift_m = 0.003F;  // above the ground, so that it is in sight
constexpr float kShadowLight = 0.72F;
constexpr float kBlend = 0.012F;  // over which the skin passes from one bone to the next

std::vector<Capsule> capsules_of(const Skeleton& s) {
  const Vec3f hips = 0.5F * (s.hip[0] + s.hip[1]), neck = 0.5F * (s.shoulder[0] + s.shoulder[1]);
  const Vec3f top(neck.x(), neck.y(), 1.0F);
  std::vector<Capsule> capsules = {
      {kTorsoBone, hips, neck, 0.075F},
      {kTorsoBone, 0.8F * s.hip[0] + 0.2F * hips, 0.8F * s.hip[1] + 0.2F * hips, 0.045F},
      {kTorsoBone, 0.75F * s.shoulder[0] + 0.25F * neck, 0.75F * s.shoulder[1] + 0.25F * neck,
       0.035F},
      {kHead, 0.7F * neck + 0.3F * top, top, 0.05F}};
  for (int i = 0; i < 2; ++i) {
    if (s.arms_swing) {
      capsules.push_back({kUpperArm + i, s.shoulder[i], s.elbow[i], 0.028F});
      capsules.push_back({kForearm + i, s.elbow[i], s.fingertips[i], 0.020F});
    } else {
      capsules.push_back({kTorsoBone, s.shoulder[i], s.elbow[i], 0.06F});
      capsules.push_back({kTorsoBone, s.elbow[i], s.fingertips[i], 0.06F});
    }
    capsules.push_back({kThigh + i, s.hip[i] - Vec3f(0, 0, 0.03F), s.knee[i], 0.045F});
    capsules.push_back({kShank + i, s.knee[i], s.ankle[i], 0.032F});
    const Vec3f heel = s.ankle[i] - 0.3F * (s.toes[i] - s.ankle[i]);
    capsules.push_back({kFoot + i, Vec3f(heel.x(), heel.y(), s.toes[i].z()), s.toes[i], 0.02F});
  }
  return capsules;
}

// `leg`: 0 left, 1 right; lower legs are never joined, however near.
PersonModel::Skin skin_of(const std::vector<Capsule>& capsules, int leg, const Vec3f& position) {
  std::array<float, kBoneCount> distance;
  distance.fill(std::numeric_limits<float>::max());
  for (const Capsule& c : capsules) {
    const float apart = c.bone >= kShank && c.bone % 2 != leg ? kOtherLeg : 0.0F;
    distance[c.bone] =
        std::min(distance[c.bone], distance_to_segment(position, c.from, c.to) - c.radius + apart);
  }
  int first = 0, second = 1;
  if (distance[1] < distance[0]) std::swap(first, second);
  for (int i = 2; i < kBoneCount; ++i) {
    if (distance[i] < distance[first])
      second = first, first = i;
    else if (distance[i] < distance[second])
      second = i;
  }
  const float gap = (distance[second] - distance[first]) / kBlend;
  return {{first, second}, 1.0F / (1.0F + std::exp(-gap))};
}

void bring_to_unit_height(PersonMesh& mesh) {
  Vec3f low = mesh.vertices.front().position, high = low;
  for (const auto& v : mesh.vertices) {
    low = low.cwiseMin(v.position);
    high = high.cwiseMax(v.position);
  }
  const float height = high.z() - low.z();
  if (!(height > 0.0F)) throw std::invalid_argument("make_person_model: the mesh has no height");
  const Vec3f origin(0.5F * (low.x() + high.x()), 0.5F * (low.y() + high.y()), low.z());
  for (auto& v : mesh.vertices) v.position = (v.position - origin) / height;
}

void check(const PersonMesh& mesh) {
  if (mesh.triangles.empty()) throw std::invalid_argument("make_person_model: no triangles");
  const int vertices = static_cast<int>(mesh.vertices.size());
  const int textures = static_cast<int>(mesh.textures.size());
  for (const auto& t : mesh.triangles)
    for (const int v : t.vertices)
      if (v < 0 || v >= vertices || t.texture < 0 || t.texture >= textures)
        throw std::invalid_argument("make_person_model: a triangle's index is out of range");
}

// Where a bone is to be, and what takes it there.
struct Poser {
  const std::array<Vec3, kLandmarkCount>& joints;
  float height;
  Eigen::Matrix3f upright;  // body axes in the world
  std::array<Bend, kBoneCount> bends;

  Vec3f joint(int index) const { return joints[index].cast<float>(); }

  // Rest segment → segment in the world: the body's attitude, then the least turn, stretched along.
  Bend bend(const Vec3f& rest_from, const Vec3f& rest_to, const Vec3f& from,
            const Vec3f& to) const {
    const Vec3f rest = rest_to - rest_from, axis = rest.normalized();
    const float stretch = (to - from).norm() / (height * rest.norm());
    const Eigen::Matrix3f scale =
        height * (Eigen::Matrix3f::Identity() + (stretch - 1.0F) * axis * axis.transpose());
    const auto turn = Eigen::Quaternionf::FromTwoVectors(upright * rest, to - from);
    Bend result;
    result.linear() = turn.toRotationMatrix() * upright * scale;
    result.translation() = from - result.linear() * rest_from;
    return result;
  }
  void limb(int bone, const Vec3f& rest_from, const Vec3f& rest_to, int from, int to) {
    bends[bone] = bend(rest_from, rest_to, joint(from), joint(to));
  }
};

std::array<Bend, kBoneCount> bends_of(const PersonModel& model,
                                      const std::array<Vec3, kLandmarkCount>& joints,
                                      double height_m) {
  const Skeleton& s = model.skeleton;
  Poser p{joints, static_cast<float>(height_m), {}, {}};
  const Vec3f neck = 0.5F * (p.joint(kLeftShoulder) + p.joint(kRightShoulder));
  const Vec3f hips = 0.5F * (p.joint(kLeftHip) + p.joint(kRightHip));
  const Vec3f up = (neck - hips).normalized();
  const Vec3f left = (p.joint(kLeftShoulder) - p.joint(kRightShoulder)).normalized();
  p.upright.col(0) = left.cross(up);
  p.upright.col(1) = left;
  p.upright.col(2) = up;
  const Vec3f rest_neck = 0.5F * (s.shoulder[0] + s.shoulder[1]);
  const Vec3f rest_hips = 0.5F * (s.hip[0] + s.hip[1]);
  p.bends[kTorsoBone] = p.bend(rest_hips, rest_neck, hips, neck);
  const Vec3f top = neck + p.height * static_cast<float>(1.0 - kShoulderShare) * up;
  p.bends[kHead] = p.bend(rest_neck, Vec3f(rest_neck.x(), rest_neck.y(), 1.0F), neck, top);
  for (int i = 0; i < 2; ++i) {
    p.limb(kUpperArm + i, s.shoulder[i], s.elbow[i], 11 + i, 13 + i);
    p.limb(kForearm + i, s.elbow[i], s.wrist[i], 13 + i, 15 + i);
    p.limb(kThigh + i, s.hip[i], s.knee[i], 23 + i, 25 + i);
    p.limb(kShank + i, s.knee[i], s.ankle[i], 25 + i, 27 + i);
    p.limb(kFoot + i, s.ankle[i], s.toes[i], 27 + i, 31 + i);
  }
  return p.bends;
}

}  // namespace

PersonModel make_person_model(PersonMesh mesh, Skeleton skeleton) {
  check(mesh);
  bring_to_unit_height(mesh);
  unwind(mesh, skeleton);
  const auto capsules = capsules_of(skeleton);
  const auto legs = leg_of_each_vertex(mesh, skeleton);
  PersonModel model{std::move(mesh), skeleton, {}};
  for (std::size_t i = 0; i < legs.size(); ++i)
    model.skin.push_back(skin_of(capsules, legs[i], model.mesh.vertices[i].position));
  return model;
}

void pose_person(const PersonModel& model, const std::array<Vec3, kLandmarkCount>& joints_enu_m,
                 double height_m, std::vector<Corner>& posed) {
  const auto bends = bends_of(model, joints_enu_m, height_m);
  posed.resize(model.mesh.vertices.size());
  for (std::size_t i = 0; i < posed.size(); ++i) {
    const PersonMesh::Vertex& v = model.mesh.vertices[i];
    const PersonModel::Skin& skin = model.skin[i];
    const float w = skin.first_weight;
    const Eigen::Matrix<float, 3, 4> m =
        w * bends[skin.bones[0]].matrix() + (1.0F - w) * bends[skin.bones[1]].matrix();
    posed[i] = {m.leftCols<3>() * v.position + m.col(3), v.u, v.v,
                daylight((m.leftCols<3>() * v.normal).normalized())};
  }
}

void cast_shadow(std::span<const Corner> posed, double ground_z_m, std::vector<Corner>& shadow) {
  const Vec3f slope = sun_direction() / sun_direction().z();
  const auto ground = static_cast<float>(ground_z_m) + kShadowLift_m;
  const auto tile_m = static_cast<float>(kSurfaceTile_m[static_cast<int>(Surface::kPaving)]);
  shadow.resize(posed.size());
  for (std::size_t i = 0; i < posed.size(); ++i) {
    const Vec3f& p = posed[i].camera_m;
    const Vec3f on_ground = p - (p.z() - ground) * slope;
    shadow[i] = {on_ground, on_ground.x() / tile_m, on_ground.y() / tile_m, kShadowLight};
  }
}

void draw(Canvas& canvas, const PersonModel& model, std::span<const Corner> posed) {
  for (const auto& [v, texture] : model.mesh.triangles) {
    const std::array<Corner, 3> corners = {posed[v[0]], posed[v[1]], posed[v[2]]};
    draw(canvas, corners, model.mesh.textures[texture]);
  }
}

void draw_shadow(Canvas& canvas, const PersonModel& model, std::span<const Corner> shadow,
                 const Texture& ground) {
  for (const auto& [v, texture] : model.mesh.triangles)
    draw(canvas, std::array<Corner, 3>{shadow[v[0]], shadow[v[1]], shadow[v[2]]}, ground);
}

}  // namespace foretrack
