#include "core/perception/params.hpp"

namespace foretrack {

ParamRows rows(PerceptionParams& p) {
  return {
      {"target_height_m", &p.target_height_m, "m", 0.5, 2.5, "height of the followed person"},
      {"landmark_height_m", &p.landmark_height_m, "m", 0.5, 2.5,
       "height that the landmarks' source assumes of everybody (BlazePose: 1.70)"},
      {"min_visibility", &p.min_visibility, "1", 0.0, 1.0, "landmarks below it are not used"},
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
      {"acceleration_density_m2_s3", &p.acceleration_density_m2_s3, "m2/s3", 1e-4, 100.0,
       "horizontal process noise"},
      {"vertical_acceleration_density_m2_s3", &p.vertical_acceleration_density_m2_s3, "m2/s3", 1e-5,
       100.0, "vertical process noise"},
      {"vertical_damping_s", &p.vertical_damping_s, "s", 0.05, 100.0,
       "time constant by which vertical speed is forgotten"},
      {"initial_speed_sigma_m_s", &p.initial_speed_sigma_m_s, "m/s", 0.1, 10.0,
       "of a target seen for the first time"},
      {"gate_mahalanobis", &p.gate_mahalanobis, "1", 1.0, 100.0,
       "a measurement farther from the estimate is not used"},
      {"reinitialise_after", &p.reinitialise_after, "1", 1, 1000,
       "agreeing refused measurements in a row that start the track anew"},
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
  };
}

}  // namespace foretrack
