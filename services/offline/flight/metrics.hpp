// SPDX-License-Identifier: Apache-2.0
// What a flight was worth, from its rows alone, so that every method is measured alike.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "core/scores/truth.hpp"
#include "services/offline/flight/flight_row.hpp"

namespace foretrack {

struct MetricParams {
  double near_m = 1.0;                 // nearer to the target is a failure
  double band_low_m = 1.5;             // d_l
  double band_high_m = 2.5;            // d_u
  double vehicle_radius_m = 0.25;      // nearer to a shape is a collision
  double turn_distance_slack_m = 0.3;  // a turn may come this much below the band
  double turn_loss_s = 0.5;            // longest loss of sight that a successful turn may have
  double speed_max_m_s = 3.0;
  double acceleration_max_m_s2 = 5.0;
  double yaw_rate_max_rad_s = 3.0;
  double height_above_target_m = 0.1;  // that the vehicle wants, over the torso's centre
};

struct Quantiles {
  double p50 = 0.0, p95 = 0.0, p99 = 0.0, max = 0.0;
};
/// Of the values, by the nearest rank. Zeros if there are none.
Quantiles quantiles_of(std::vector<double> values);

/// The Wilson 95 % interval of k successes in n trials; [0, 1] without trials.
struct Interval95 {
  double low = 0.0, high = 1.0;
};
Interval95 wilson(int successes, int trials);

/// How one turn or sudden stop went. A turn succeeds without a collision, a loss of sight longer
/// than turn_loss_s in [−1, +4] s, and a distance below d_l − turn_distance_slack_m; a deceleration
/// without a collision and a distance below near_m in the 3 s that follow.
struct EventRecord {
  TruthEvent event;
  double longest_loss_s = 0.0;
  double min_distance_m = 0.0;
  bool collided = false;
  bool success = false;
};

struct Metrics {
  double duration_s = 0.0;
  // Shares of the time.
  double failure_rate = 0.0;
  double fov_loss_rate = 0.0;
  double occlusion_rate = 0.0;
  double near_rate = 0.0;
  double band_share = 0.0;
  // Loss of sight.
  int losses = 0;
  double longest_loss_s = 0.0;
  double mean_loss_s = 0.0;
  // Distance to the target, and its error max(0, d_l − d, d − d_u).
  double min_distance_m = 0.0;
  double mean_distance_m = 0.0;
  double distance_error_mean_m = 0.0;
  double distance_error_rms_m = 0.0;
  double distance_error_p95_m = 0.0;
  double view_angle_error_mean_rad = 0.0;  // bearing of the target off the nose
  // Safety.
  int collisions = 0;  // contacts, not steps
  double contact_s = 0.0;
  double min_clearance_m = 0.0;  // negative: inside; infinite in the open
  double max_speed_m_s = 0.0;
  double max_acceleration_m_s2 = 0.0;
  double max_yaw_rate_rad_s = 0.0;
  double limit_violation_s = 0.0;
  double smoothness_m2_s5 = 0.0;  // (1/T) ∫ |jerk|² dt of the vehicle
  // Gaps in space between the vehicle's hull and people; infinite without any.
  int person_contacts = 0;  // with the followed person
  double min_person_gap_m = std::numeric_limits<double>::infinity();
  int bystander_contacts = 0;
  double min_bystander_gap_m = std::numeric_limits<double>::infinity();
  // Going up out of somebody's way: what is lost then is told apart. Shares are of the other time.
  double evading_s = 0.0;
  double failure_rate_not_evading = 0.0;
  double near_rate_not_evading = 0.0;
  double unseen_rate_not_evading = 0.0;
  // Turns and stops of the target.
  int turns = 0;
  int turn_successes = 0;
  Interval95 turn_success_95;
  int decelerations = 0;
  double deceleration_min_distance_m = 0.0;  // within 3 s after the beginning; 0 without any
  double deceleration_below_band_s = 0.0;
  // Intention, against labels from the true future.
  double brier = 0.0;
  double brier_base = 0.0;  // of always saying this flight's base rate
  int foreseen = 0;         // turns that were announced when they began
  double lead_time_median_s = 0.0;
  double false_alarms_per_min = 0.0;
  // Most probable path, 0.5, 1, 2 and 3 s ahead: mean error.
  std::array<double, kForesight_s.size()> foresight_error_m{};
  Quantiles plan_ms;  // processor time of a step that replans; not part of the log
  std::vector<EventRecord> turn_records;
  std::vector<EventRecord> deceleration_records;
};

/// Definitions: docs/metrics.md. Precondition: rows at equal steps. plan_ms stays empty.
Metrics metrics_of(std::span<const FlightRow> rows, const MetricParams& params);

}  // namespace foretrack
