// SPDX-License-Identifier: Apache-2.0
// The parameters of perception.
#pragma once

#include "core/common/params.hpp"

namespace foretrack {

/// Ranges are in the rows: see rows(), or `foretrack params perception`.
struct PerceptionParams {
  // Images → landmarks.
  int model_complexity = 1;          ///< of the pose network: 0 lite, 1 full, 2 heavy
  double min_detection_score = 0.5;  ///< people whom the detector is less certain of are nobody
  double min_pose_score = 0.5;       ///< regions with a smaller probability of a person are empty
  double detector_period_s = 0.025;  ///< while nobody is tracked, the detector runs no more often
  /// a tracked torso that jumps farther in one image, in sizes of the body, is somebody else
  double jump_ratio = 0.3;
  /// a lost person is found again within so many sizes of the body, as many more with each second:
  /// walking pace
  double choice_gate_ratio = 0.7;
  /// a lost person is waited for by place and clothes; after this time anybody may be the person
  double choice_memory_s = 5.0;
  /// whose torso's colour differs more from the chosen person's is somebody else; 1: red and grey
  double clothes_gate = 0.4;
  /// while somebody is tracked, the detector looks for others around them no more often
  double watch_period_s = 0.12;
  /// nearer to the person, in sizes of the body, another one may be taken for them
  double doubt_ratio = 0.4;
  /// then a pose whose place, size and clothes are farther from theirs, in standard deviations, is
  /// not taken
  double doubt_gate = 2.5;
  /// the same of who was lost and is found again, while nobody is known to be near
  double change_gate = 5.0;
  // Landmarks → pose of the body in the camera.
  double target_height_m = 1.75;  ///< height of the followed person
  /// height that the landmarks' source assumes of everybody (BlazePose: 1.62)
  double landmark_height_m = 1.75;
  double min_visibility = 0.5;  ///< landmarks below it are not used
  double ground_m = 0.0;        ///< height of the ground on which people stand, in the world
  int min_landmarks = 8;        ///< fewer agreeing landmarks are no pose
  int consensus_samples = 24;   ///< pairs tried to find the start
  /// a joint farther from its image ray disagrees with the start
  double consensus_radius_m = 0.25;
  double image_noise_px = 2.0;        ///< standard deviation, per axis
  double joint_noise_m = 0.03;        ///< standard deviation, per axis
  double alignment_noise_rad = 0.25;  ///< how far the joints' axes may be from the camera's
  double max_range_m = 12.0;          ///< poses beyond it are refused
  // Noise of the torso measurement.
  double lateral_noise_m = 0.02;     ///< of the measured position, across the line of sight
  double range_noise_ratio = 0.016;  ///< added along the line of sight, per metre of range
  double yaw_noise_rad = 0.14;       ///< of the measured body yaw
  /// from the torso's surface, which depth images see, to its middle
  double torso_half_depth_m = 0.11;
  double depth_noise_m = 0.04;  ///< along the line of sight, if a depth image gave the range
  /// a depth that differs more from the landmarks' range, relative to it, is not used
  double depth_agreement_ratio = 0.3;
  // Filter.
  /// horizontal process noise: spectral density of the acceleration
  double steady_density_m2_s3 = 0.22;
  double manoeuvre_density_m2_s3 = 5.0;  ///< the same while the target turns, stops or starts
  /// time over which innovations are averaged to notice a manoeuvre
  double manoeuvre_memory_s = 0.12;
  /// it is no more than this while measurements are refused that may be somebody else's
  double doubt_density_m2_s3 = 0.22;
  double manoeuvre_level = 0.65;  ///< their mean, in standard deviations, from which on it is one
  /// vertical process noise: spectral density of the acceleration
  double vertical_density_m2_s3 = 0.05;
  double vertical_damping_s = 0.5;       ///< time constant by which vertical speed is forgotten
  double initial_speed_sigma_m_s = 1.0;  ///< of a target seen for the first time
  double gate_mahalanobis = 4.0;         ///< a measurement farther from the estimate is not used
  int reinitialise_after = 5;  ///< agreeing refused measurements in a row that start the track anew
  int reinitialise_doubtful_after = 30;  ///< the same if they may be somebody else's
  double reinitialise_radius_m = 1.0;    ///< within which they agree
  double yaw_density_rad2_s = 0.2;       ///< process noise of the body yaw
  double yaw_gate_rad = 1.6;             ///< a yaw farther away is a flip
  // Age of the last accepted measurement.
  /// age of the last measurement up to which the target is tracked; then it coasts
  double tracking_age_s = 0.25;
  double lost_age_s = 2.0;       ///< age from which it is lost
  double reorder_limit_s = 0.5;  ///< measurements later than this are not filtered in
  // What is too old.
  double delay_max_s = 1.0;    ///< of measurements that come late: no more is made up for
  double image_stale_s = 0.3;  ///< an older image is not looked at
  /// so long after an image was looked at, no other source of observations counts
  double own_images_s = 1.0;
  /// a depth image this near in time shows what the colour image does
  double same_instant_s = 0.025;
  double vehicle_stale_s = 0.5;  ///< an older vehicle state counts as none, and perception says so
};

/// One row for each field: name, unit, range, meaning.
ParamRows rows(PerceptionParams& p);

}  // namespace foretrack
