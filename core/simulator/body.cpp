// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/body.hpp"

#include <algorithm>

namespace foretrack {
namespace {

// Standing joints of a person 1 m tall in the body frame, feet at z = 0 (x forward, y left). After
// common anthropometric proportions (Drillis and Contini 1966). Only the left side and the middle.
struct JointRow {
  int left, right;  // equal: in the middle
  double x, y, z;
};
constexpr JointRow kJoints[] = {{0, 0, 0.06, 0.0, 0.925},
                                {1, 4, 0.05, 0.010, 0.942},
                                {2, 5, 0.05, 0.019, 0.942},
                                {3, 6, 0.045, 0.028, 0.942},
                                {7, 8, 0.0, 0.043, 0.932},
                                {9, 10, 0.052, 0.014, 0.902},
                                {11, 12, 0.0, 0.105, kShoulderShare},
                                {13, 14, 0.0, 0.125, 0.635},
                                {15, 16, 0.02, 0.130, 0.490},
                                {17, 18, 0.025, 0.133, 0.445},
                                {19, 20, 0.030, 0.128, 0.435},
                                {21, 22, 0.035, 0.120, 0.460},
                                {23, 24, 0.0, 0.055, 0.530},
                                {25, 26, 0.005, 0.055, 0.285},
                                {27, 28, 0.0, 0.055, 0.045},
                                {29, 30, -0.025, 0.055, 0.02},
                                {31, 32, 0.095, 0.062, 0.015}};
constexpr double kTorso = 0.5 * (kShoulderShare + 0.530);
constexpr double kSwingSpeed_m_s = 1.0;  // full swing of the limbs from this speed on

// A limb turns about its first joint, and bends at its second one.
struct Limb {
  int first[2], second[2];        // left, right
  std::array<int, 4> further[2];  // beyond the second joint
  double swing_rad;               // of the whole limb to either side
  double bend_rad;                // of the second joint: always, and more while swinging forward
  double swing_bend_rad;
};
constexpr Limb kLimbs[] = {
    {{23, 24}, {25, 26}, {{27, 29, 31, -1}, {28, 30, 32, -1}}, 0.40, -0.10, -0.75},
    {{11, 12}, {13, 14}, {{15, 17, 19, 21}, {16, 18, 20, 22}}, -0.30, 0.25, 0.20}};

Vec3 about_y(const Vec3& pivot, const Vec3& p, double angle_rad) {
  const Vec3 d = p - pivot;
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return pivot + Vec3(c * d.x() - s * d.z(), d.y(), s * d.x() + c * d.z());
}

void swing(const Limb& limb, int side, double stride_rad, double gait,
           std::array<Vec3, kLandmarkCount>& joints) {
  const double turn = gait * limb.swing_rad * std::sin(stride_rad);
  const double forward = std::max(0.0, std::cos(stride_rad) * (limb.swing_rad > 0.0 ? 1.0 : -1.0));
  const double bend = gait * (limb.bend_rad + limb.swing_bend_rad * forward);
  const Vec3 first = joints[limb.first[side]], second = joints[limb.second[side]];
  joints[limb.second[side]] = about_y(first, second, turn);
  for (const int i : limb.further[side])
    if (i >= 0) joints[i] = about_y(first, about_y(second, joints[i], bend), turn);
}

void walk(std::array<Vec3, kLandmarkCount>& joints, const PersonState& state) {
  const double speed = state.velocity_enu_m_s.head<2>().norm();
  const double gait = std::min(1.0, speed / kSwingSpeed_m_s);
  for (const Limb& limb : kLimbs)
    for (const int side : {0, 1}) swing(limb, side, state.stride_rad + side * kPi, gait, joints);
}

// About the neck, whose axis is the body's. Landmarks up to the mouth are the head's.
void turn_head(std::array<Vec3, kLandmarkCount>& joints, double turn_rad) {
  constexpr int kLastOfHead = 10;
  if (turn_rad == 0.0) return;
  const Eigen::AngleAxisd turn(turn_rad, Vec3::UnitZ());
  for (int i = 0; i <= kLastOfHead; ++i) joints[i] = turn * joints[i];
}

}  // namespace

double torso_height_m(double height_m) {
  return kTorso * height_m;
}

std::array<Vec3, kLandmarkCount> joints_enu_m(const PersonState& state, double height_m) {
  std::array<Vec3, kLandmarkCount> joints;
  for (const JointRow& row : kJoints) {
    joints[row.left] = {row.x, row.y, row.z - kTorso};
    joints[row.right] = {row.x, row.left == row.right ? row.y : -row.y, row.z - kTorso};
  }
  walk(joints, state);
  turn_head(joints, state.head_turn_rad);
  const Vec2 forward = direction_of(state.body_yaw_rad);
  Mat3 r_world_body = Mat3::Identity();
  r_world_body.col(0).head<2>() = forward;
  r_world_body.col(1).head<2>() = Vec2(-forward.y(), forward.x());
  for (Vec3& joint : joints) joint = state.position_enu_m + height_m * (r_world_body * joint);
  return joints;
}

std::array<Vec3, 5> body_points_enu_m(const PersonState& state, double height_m) {
  const Vec3 up = height_m * Vec3::UnitZ();
  const Vec2 forward = direction_of(state.body_yaw_rad);
  const Vec3 left = 0.105 * height_m * Vec3(-forward.y(), forward.x(), 0.0);
  const Vec3& torso = state.position_enu_m;
  const Vec3 shoulders = torso + (kShoulderShare - kTorso) * up;
  return {torso + (0.925 - kTorso) * up, shoulders + left, shoulders - left,
          torso + (0.530 - kTorso) * up, torso + (0.285 - kTorso) * up};
}

}  // namespace foretrack
