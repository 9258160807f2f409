// SPDX-License-Identifier: Apache-2.0
#include "core/perception/body_pose.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

using PoseStep = Eigen::Matrix<double, 6, 1>;  // rotation, translation
using Mat26 = Eigen::Matrix<double, 2, 6>;

constexpr int kRefinements = 12;
constexpr int kWideRefinements = 2;
constexpr double kStartSigmas = 12.0;
constexpr double kMostNoiseScale = 3.0;
constexpr double kInlierSigmas = 4.0;

struct Pair {
  Vec2 ray;     // image point at z = 1
  Vec3 body_m;  // scaled to the target's height
  int landmark;
};

struct Pairs {
  std::array<Pair, kLandmarkCount> items;
  int count = 0;
  const Pair* begin() const { return items.data(); }
  const Pair* end() const { return items.data() + count; }
};

bool is_visible(const Landmark& landmark, const PerceptionParams& params) {
  return landmark.visibility > params.min_visibility && landmark.image_px.allFinite() &&
         landmark.body_m.allFinite();
}

// From the height that the landmarks' source assumes to that of this person.
double height_scale(const PerceptionParams& params) {
  return params.target_height_m / params.landmark_height_m;
}

Vec2 ray_of(const Vec2& image_px, const CameraModel& camera) {
  return {(image_px.x() - camera.cx_px) / camera.fx_px,
          (image_px.y() - camera.cy_px) / camera.fy_px};
}

Pairs visible_pairs(const std::array<Landmark, kLandmarkCount>& landmarks,
                    const CameraModel& camera, const PerceptionParams& params) {
  const double scale = height_scale(params);
  Pairs pairs;
  for (int i = 0; i < kLandmarkCount; ++i) {
    const Landmark& l = landmarks[i];
    if (!is_visible(l, params)) continue;
    pairs.items[pairs.count++] = {ray_of(l.image_px, camera), scale * l.body_m, i};
  }
  return pairs;
}

// x/z = ray of both points gives four equations that are linear in t when R = I.
Vec3 translation_of(const Pair& a, const Pair& b) {
  Mat3 normal = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (const Pair* p : {&a, &b})
    for (int axis = 0; axis < 2; ++axis) {
      Vec3 row = Vec3::Zero();
      row[axis] = 1.0;
      row.z() = -p->ray[axis];
      normal += row * row.transpose();
      right += row * (p->ray[axis] * p->body_m.z() - p->body_m[axis]);
    }
  return normal.inverse() * right;
}

// Sum of the squared distances from the rays, each at most the radius squared (MSAC).
double disagreement(const Pairs& pairs, const Vec3& t, double radius_m) {
  double sum = 0.0;
  for (const Pair& p : pairs) {
    const Vec3 x = p.body_m + t;
    const double miss2 = (x.head<2>() - x.z() * p.ray).squaredNorm();
    sum += x.z() > 0.1 ? std::min(miss2, radius_m * radius_m) : radius_m * radius_m;
  }
  return sum;
}

Vec3 consensus_translation(const Pairs& pairs, const PerceptionParams& params) {
  Random random(1);
  Vec3 best = Vec3(0.0, 0.0, 3.0);
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < params.consensus_samples; ++k) {
    const int i = random.integer(0, pairs.count - 1);
    const int j = (i + random.integer(1, pairs.count - 1)) % pairs.count;
    const Vec3 t = translation_of(pairs.items[i], pairs.items[j]);
    if (!t.allFinite()) continue;
    const double sum = disagreement(pairs, t, params.consensus_radius_m);
    if (sum < least) least = sum, best = t;
  }
  return best;
}

Mat3 skew(const Vec3& v) {
  Mat3 s;
  s << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return s;
}

// The axes come near the camera's.
double alignment_information(const PerceptionParams& params) {
  return 1.0 / (params.alignment_noise_rad * params.alignment_noise_rad);
}

// One pose and what its landmarks say of it.
struct Refiner {
  const Pairs& pairs;
  const PerceptionParams& params;
  double focal_px;
  Mat3 R = Mat3::Identity();
  Vec3 t;
  double scale = 1.0;  // of the noise

  double sigma_at(double z) const {
    return scale * std::hypot(params.image_noise_px / focal_px, params.joint_noise_m / z);
  }
  // Image error of a pair in standard deviations; infinite behind the camera.
  double error_of(const Pair& p) const {
    const Vec3 x = R * p.body_m + t;
    if (x.z() < 0.1) return std::numeric_limits<double>::infinity();
    return (x.head<2>() / x.z() - p.ray).norm() / sigma_at(x.z());
  }
  // `width`: errors beyond this many standard deviations count less and less.
  double step(double width) {
    Mat6 normal = Mat6::Zero();
    PoseStep right = PoseStep::Zero();
    for (const Pair& p : pairs) accumulate(p, width, normal, right);
    const Eigen::AngleAxisd turned(R);
    const double information = alignment_information(params);
    normal.topLeftCorner<3, 3>().diagonal().array() += information;
    right.head<3>() -= information * turned.angle() * turned.axis();
    const PoseStep delta = normal.ldlt().solve(right);
    const double angle = delta.head<3>().norm();
    if (angle > 1e-12) R = Eigen::AngleAxisd(angle, delta.head<3>() / angle) * R;
    t += delta.tail<3>();
    return delta.norm();
  }
  void accumulate(const Pair& p, double width, Mat6& normal, PoseStep& right) const {
    const Vec3 rotated = R * p.body_m;
    const Vec3 x = rotated + t;
    if (x.z() < 0.1) return;
    const double iz = 1.0 / x.z();
    const Vec2 error = p.ray - x.head<2>() * iz;
    Eigen::Matrix<double, 2, 3> image;
    image << iz, 0, -x.x() * iz * iz, 0, iz, -x.y() * iz * iz;
    Mat26 jacobian;
    jacobian << -image * skew(rotated), image;
    const double sigma = sigma_at(x.z());
    const double ratio = error.squaredNorm() / (sigma * sigma * width * width);
    const double weight = 1.0 / ((1.0 + ratio) * (1.0 + ratio) * sigma * sigma);
    normal.noalias() += weight * jacobian.transpose() * jacobian;
    right.noalias() += weight * jacobian.transpose() * error;
  }
};

// What the landmarks that `counts` tell of the pose, were they where the pose puts them.
template <class Counts>
Mat6 information_of(const Refiner& refiner, const std::array<Landmark, kLandmarkCount>& landmarks,
                    const Counts& counts) {
  const double scale = height_scale(refiner.params);
  Mat6 normal = Mat6::Zero();
  PoseStep unused = PoseStep::Zero();
  for (int i = 0; i < kLandmarkCount; ++i) {
    if (!counts(i) || !landmarks[i].body_m.allFinite()) continue;
    const Vec3 x = refiner.R * (scale * landmarks[i].body_m) + refiner.t;
    if (x.z() < 0.1) continue;
    refiner.accumulate({x.head<2>() / x.z(), scale * landmarks[i].body_m, i}, kStartSigmas, normal,
                       unused);
  }
  normal.topLeftCorner<3, 3>().diagonal().array() += alignment_information(refiner.params);
  return normal;
}

// Of the torso's centre, from the information on the pose.
Mat3 torso_covariance(const Vec3& from_hips_m, const Mat6& information) {
  Eigen::Matrix<double, 3, 6> by_pose;
  by_pose << -skew(from_hips_m), Mat3::Identity();
  return by_pose * information.ldlt().solve(by_pose.transpose());
}

// Median error over the one that is expected of normal noise in the plane.
double noise_scale(const Refiner& refiner) {
  std::array<double, kLandmarkCount> errors;
  double* end = errors.data();
  for (const Pair& p : refiner.pairs) *end++ = refiner.error_of(p);
  double* middle = errors.data() + refiner.pairs.count / 2;
  std::nth_element(errors.data(), middle, end);
  return std::clamp(*middle / 1.177, 1.0, kMostNoiseScale);
}

// The loss starts wide and narrows, so that the start need not be good.
void refine(Refiner& refiner) {
  double width = kStartSigmas;
  for (int k = 0; k < kRefinements; ++k) {
    if (k == kWideRefinements) refiner.scale = noise_scale(refiner);
    const double moved = refiner.step(width);
    if (width == kInlierSigmas && moved < 1e-5) return;
    if (k >= kWideRefinements) width = std::max(0.6 * width, kInlierSigmas);
  }
}

}  // namespace

int visible_count(const std::array<Landmark, kLandmarkCount>& landmarks,
                  const PerceptionParams& params) {
  int count = 0;
  for (const Landmark& l : landmarks) count += is_visible(l, params);
  return count;
}

Vec3 torso_camera_m(const BodyPose& pose, const std::array<Landmark, kLandmarkCount>& landmarks,
                    const PerceptionParams& params) {
  const double scale = height_scale(params);
  const auto joint = [&](TorsoJoint j) -> Vec3 {
    return pose.joint_camera_m(scale * landmarks[j].body_m);
  };
  return 0.25 * (joint(kLeftShoulder) + joint(kRightShoulder) + joint(kLeftHip) + joint(kRightHip));
}

Vec3 seen_joint_m(const BodyPose& pose, const Landmark& landmark, const CameraModel& camera,
                  const PerceptionParams& params) {
  const double depth_m = pose.joint_camera_m(height_scale(params) * landmark.body_m).z();
  return depth_m * ray_of(landmark.image_px, camera).homogeneous();
}

std::optional<BodyPose> estimate_body_pose(const std::array<Landmark, kLandmarkCount>& landmarks,
                                           const CameraModel& camera,
                                           const PerceptionParams& params) {
  const Pairs pairs = visible_pairs(landmarks, camera, params);
  if (pairs.count < std::max(params.min_landmarks, 2)) return std::nullopt;
  Refiner refiner{pairs, params, camera.fx_px, Mat3::Identity(),
                  consensus_translation(pairs, params)};
  refine(refiner);
  if (!refiner.R.allFinite() || !refiner.t.allFinite()) return std::nullopt;

  BodyPose pose;
  pose.T_camera_human.linear() = refiner.R;
  pose.T_camera_human.translation() = refiner.t;
  double sum = 0.0;
  for (const Pair& p : pairs) {
    if (refiner.error_of(p) > kInlierSigmas) continue;
    pose.used[p.landmark] = true;
    ++pose.used_count;
    const Vec2 image = *camera.project(refiner.R * p.body_m + refiner.t);
    sum += (image - landmarks[p.landmark].image_px).squaredNorm();
  }
  if (pose.used_count < params.min_landmarks || 2 * pose.used_count < pairs.count)
    return std::nullopt;
  if (refiner.t.z() < 0.1 || refiner.t.norm() > params.max_range_m) return std::nullopt;
  pose.noise_scale = refiner.scale;
  const Vec3 from_hips_m = torso_camera_m(pose, landmarks, params) - refiner.t;
  const Mat6 seen = information_of(refiner, landmarks, [&](int i) { return pose.used[i]; });
  const Mat6 whole = information_of(refiner, landmarks, [](int) { return true; });
  pose.cut_off_covariance_m2 =
      torso_covariance(from_hips_m, seen) - torso_covariance(from_hips_m, whole);
  pose.reprojection_rms_px = std::sqrt(sum / pose.used_count);
  return pose;
}

}  // namespace foretrack
