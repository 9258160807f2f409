// SPDX-License-Identifier: Apache-2.0
// The parameters of perception.
#pragma once

#include "core/common/params.hpp"

namespace foretrack {

/// What each of them means, and its range, is in its row: see rows(), or `foretrack params
/// perception`.
struct PerceptionParams {
  // Images → landmarks.
  int model_complexity = 1;
  double min_detection_score = 0.5;
  double min_pose_score = 0.5;
  double detector_period_s = 0.025;
  double jump_ratio = 0.3;
  double choice_gate_ratio = 0.7;
  double choice_memory_s = 5.0;
  double clothes_gate = 0.4;
  double watch_period_s = 0.12;
  double doubt_ratio = 0.4;
  double doubt_gate = 2.5;
  double change_gate = 5.0;
  // Landmarks → pose of the body in the camera.
  double target_height_m = 1.75;
  double landmark_height_m = 1.75;
  double min_visibility = 0.5;
  int min_landmarks = 8;
  int consensus_samples = 24;
  double consensus_radius_m = 0.25;
  double image_noise_px = 2.0;
  double joint_noise_m = 0.03;
  double alignment_noise_rad = 0.25;
  double max_range_m = 12.0;
  // Noise of the torso measurement.
  double lateral_noise_m = 0.02;
  double range_noise_ratio = 0.016;
  double yaw_noise_rad = 0.14;
  double torso_half_depth_m = 0.11;
  double depth_noise_m = 0.04;
  double depth_agreement_ratio = 0.3;
  // Filter.
  double steady_density_m2_s3 = 0.22;
  double manoeuvre_density_m2_s3 = 5.0;
  double manoeuvre_memory_s = 0.12;
  double doubt_density_m2_s3 = 0.22;
  double manoeuvre_level = 0.65;
  double vertical_density_m2_s3 = 0.05;
  double vertical_damping_s = 0.5;
  double initial_speed_sigma_m_s = 1.0;
  double gate_mahalanobis = 4.0;
  int reinitialise_after = 5;
  int reinitialise_doubtful_after = 30;
  double reinitialise_radius_m = 1.0;
  double yaw_density_rad2_s = 0.2;
  double yaw_gate_rad = 1.6;
  // Age of the last accepted measurement.
  double tracking_age_s = 0.25;
  double lost_age_s = 2.0;
  double reorder_limit_s = 0.5;
};

/// One row for each field: name, unit, range, meaning.
ParamRows rows(PerceptionParams& p);

}  // namespace foretrack
