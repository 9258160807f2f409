// SPDX-License-Identifier: Apache-2.0
#include "core/perception/params.hpp"

namespace foretrack {
namespace {

ParamRows rows_of_images(PerceptionParams& p) {
  return {
      {"model_complexity", &p.model_complexity, "1", 0, 2,
       "of the pose network: 0 lite, 1 full, 2 heavy"},
      {"min_detection_score", &p.min_detection_score, "1", 0.05, 1.0,
       "people whom the detector is less certain of are nobody"},
      {"min_pose_score", &p.min_pose_score, "1", 0.05, 1.0,
       "regions with a smaller probability of a person are empty"},
      {"detector_period_s", &p.detector_period_s, "s", 0.0, 10.0,
       "while nobody is tracked, the detector runs no more often"},
      {"jump_ratio", &p.jump_ratio, "1", 0.05, 2.0,
       "a tracked torso that jumps farther in one image, in sizes of the body, is somebody else"},
      {"choice_gate_ratio", &p.choice_gate_ratio, "1", 0.05, 10.0,
       "a lost person is found again within so many sizes of the body, as many more with each "
       "second: walking pace"},
      {"choice_memory_s", &p.choice_memory_s, "s", 0.0, 60.0,
       "a lost person is waited for by place and clothes; after this time anybody may be the "
       "person"},
      {"clothes_gate", &p.clothes_gate, "1", 0.05, 100.0,
       "whose torso's colour differs more from the chosen person's is somebody else; 1: red and "
       "grey"},
      {"watch_period_s", &p.watch_period_s, "s", 0.0, 10.0,
       "while somebody is tracked, the detector looks for others around them no more often"},
      {"doubt_ratio", &p.doubt_ratio, "1", 0.0, 5.0,
       "nearer to the person, in sizes of the body, another one may be taken for them"},
      {"doubt_gate", &p.doubt_gate, "1", 0.5, 100.0,
       "then a pose whose place, size and clothes are farther from theirs, in standard deviations, "
       "is not taken"},
      {"change_gate", &p.change_gate, "1", 0.5, 100.0,
       "the same of who was lost and is found again, while nobody is known to be near"},
  };
}

ParamRows rows_of_pose(PerceptionParams& p) {
  return {
      {"target_height_m", &p.target_height_m, "m", 0.5, 2.5, "height of the followed person"},
      {"landmark_height_m", &p.landmark_height_m, "m", 0.5, 2.5,
       "height that the landmarks' source assumes of everybody (BlazePose: 1.62)"},
      {"min_visibility", &p.min_visibility, "1", 0.0, 1.0, "landmarks below it are not used"},
      {"ground_m", &p.ground_m, "m", -1e4, 1e4,
       "height of the ground on which people stand, in the world"},
      {"min_landmarks", &p.min_landmarks, "1", 4, 33, "fewer agreeing landmarks are no pose"},
      {"consensus_samples", &p.consensus_samples, "1", 1, 500, "pairs tried to find the start"},
      {"consensus_radius_m", &p.consensus_radius_m, "m", 0.02, 2.0,
       "a joint farther from its image ray disagrees with the start"},
      {"image_noise_px", &p.image_noise_px, "px", 0.1, 50.0, "standard deviation, per axis"},
      {"joint_noise_m", &p.joint_noise_m, "m", 0.001, 0.5, "standard deviation, per axis"},
      {"alignment_noise_rad", &p.alignment_noise_rad, "rad", 0.001, 3.2,
       "how far the joints' axes may be from the camera's"},
      {"max_range_m", &p.max_range_m, "m", 1.0, 100.0, "poses beyond it are refused"},
      {"lateral_noise_m", &p.lateral_noise_m, "m", 0.001, 1.0,
       "of the measured position, across the line of sight"},
      {"range_noise_ratio", &p.range_noise_ratio, "1", 0.0, 0.5,
       "added along the line of sight, per metre of range"},
      {"yaw_noise_rad", &p.yaw_noise_rad, "rad", 0.01, 1.5, "of the measured body yaw"},
      {"torso_half_depth_m", &p.torso_half_depth_m, "m", 0.0, 0.5,
       "from the torso's surface, which depth images see, to its middle"},
      {"depth_noise_m", &p.depth_noise_m, "m", 0.001, 1.0,
       "along the line of sight, if a depth image gave the range"},
      {"depth_agreement_ratio", &p.depth_agreement_ratio, "1", 0.0, 1.0,
       "a depth that differs more from the landmarks' range, relative to it, is not used"},
  };
}

ParamRows rows_of_filter(PerceptionParams& p) {
  return {
      {"steady_density_m2_s3", &p.steady_density_m2_s3, "m2/s3", 1e-4, 100.0,
       "horizontal process noise: spectral density of the acceleration"},
      {"manoeuvre_density_m2_s3", &p.manoeuvre_density_m2_s3, "m2/s3", 1e-4, 100.0,
       "the same while the target turns, stops or starts"},
      {"doubt_density_m2_s3", &p.doubt_density_m2_s3, "m2/s3", 1e-4, 100.0,
       "it is no more than this while measurements are refused that may be somebody else's"},
      {"manoeuvre_memory_s", &p.manoeuvre_memory_s, "s", 0.01, 5.0,
       "time over which innovations are averaged to notice a manoeuvre"},
      {"manoeuvre_level", &p.manoeuvre_level, "1", 0.05, 10.0,
       "their mean, in standard deviations, from which on it is one"},
      {"vertical_density_m2_s3", &p.vertical_density_m2_s3, "m2/s3", 1e-5, 100.0,
       "vertical process noise: spectral density of the acceleration"},
      {"vertical_damping_s", &p.vertical_damping_s, "s", 0.05, 100.0,
       "time constant by which vertical speed is forgotten"},
      {"initial_speed_sigma_m_s", &p.initial_speed_sigma_m_s, "m/s", 0.1, 10.0,
       "of a target seen for the first time"},
      {"gate_mahalanobis", &p.gate_mahalanobis, "1", 1.0, 100.0,
       "a measurement farther from the estimate is not used"},
      {"reinitialise_after", &p.reinitialise_after, "1", 1, 1000,
       "agreeing refused measurements in a row that start the track anew"},
      {"reinitialise_doubtful_after", &p.reinitialise_doubtful_after, "1", 1, 1000,
       "the same if they may be somebody else's"},
      {"reinitialise_radius_m", &p.reinitialise_radius_m, "m", 0.05, 10.0,
       "within which they agree"},
      {"yaw_density_rad2_s", &p.yaw_density_rad2_s, "rad2/s", 1e-4, 100.0,
       "process noise of the body yaw"},
      {"yaw_gate_rad", &p.yaw_gate_rad, "rad", 0.1, 3.2, "a yaw farther away is a flip"},
      {"tracking_age_s", &p.tracking_age_s, "s", 0.01, 10.0,
       "age of the last measurement up to which the target is tracked; then it coasts"},
      {"lost_age_s", &p.lost_age_s, "s", 0.05, 60.0, "age from which it is lost"},
      {"reorder_limit_s", &p.reorder_limit_s, "s", 0.0, 10.0,
       "measurements later than this are not filtered in"},
      {"delay_max_s", &p.delay_max_s, "s", 0.0, 10.0,
       "of measurements that come late: no more is made up for"},
      {"image_stale_s", &p.image_stale_s, "s", 0.01, 10.0, "an older image is not looked at"},
      {"own_images_s", &p.own_images_s, "s", 0.05, 60.0,
       "so long after an image was looked at, no other source of observations counts"},
      {"same_instant_s", &p.same_instant_s, "s", 1e-6, 0.5,
       "a depth image this near in time shows what the colour image does"},
      {"vehicle_stale_s", &p.vehicle_stale_s, "s", 0.05, 60.0,
       "an older vehicle state counts as none, and perception says so"},
  };
}

}  // namespace

ParamRows rows(PerceptionParams& p) {
  ParamRows all = rows_of_images(p);
  for (const ParamRows& part : {rows_of_pose(p), rows_of_filter(p)})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace foretrack
