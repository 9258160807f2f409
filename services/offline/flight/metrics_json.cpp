// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/metrics_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace foretrack {
namespace {

using Json = nlohmann::ordered_json;

Json json_of_turn(const EventRecord& turn) {
  return {{"kind", row_of(turn.event.kind).name},
          {"begin_s", turn.event.begin_s},
          {"end_s", turn.event.end_s},
          {"turn_rad", turn.event.turn_rad},
          {"longest_loss_s", turn.longest_loss_s},
          {"min_distance_m", turn.min_distance_m},
          {"collided", turn.collided},
          {"success", turn.success}};
}

Json tracking(const Metrics& m) {
  return {{"failure_rate", m.failure_rate},
          {"fov_loss_rate", m.fov_loss_rate},
          {"occlusion_rate", m.occlusion_rate},
          {"near_rate", m.near_rate},
          {"losses", m.losses},
          {"longest_loss_s", m.longest_loss_s},
          {"mean_loss_s", m.mean_loss_s},
          {"min_distance_m", m.min_distance_m},
          {"mean_distance_m", m.mean_distance_m},
          {"band_share", m.band_share},
          {"distance_error_mean_m", m.distance_error_mean_m},
          {"distance_error_rms_m", m.distance_error_rms_m},
          {"distance_error_p95_m", m.distance_error_p95_m},
          {"view_angle_error_mean_rad", m.view_angle_error_mean_rad}};
}

Json safety(const Metrics& m) {
  return {{"collisions", m.collisions},
          {"contact_s", m.contact_s},
          {"min_clearance_m", finite_json(m.min_clearance_m)},
          {"max_speed_m_s", m.max_speed_m_s},
          {"max_acceleration_m_s2", m.max_acceleration_m_s2},
          {"max_yaw_rate_rad_s", m.max_yaw_rate_rad_s},
          {"limit_violation_s", m.limit_violation_s},
          {"smoothness_m2_s5", m.smoothness_m2_s5}};
}

Json events(const Metrics& m) {
  Json turns = Json::array();
  for (const auto& turn : m.turn_records) turns.push_back(json_of_turn(turn));
  return {{"turns", m.turns},
          {"turn_successes", m.turn_successes},
          {"turn_success_95", {m.turn_success_95.low, m.turn_success_95.high}},
          {"decelerations", m.decelerations},
          {"deceleration_min_distance_m", m.deceleration_min_distance_m},
          {"deceleration_below_band_s", m.deceleration_below_band_s},
          {"turn_records", turns}};
}

Json foresight(const Metrics& m) {
  Json errors = Json::object();
  for (std::size_t i = 0; i < kForesight_s.size(); ++i) {
    const std::string seconds = std::to_string(kForesight_s[i]).substr(0, 3);
    errors["error_m_" + seconds + "s"] = m.foresight_error_m[i];
  }
  return {{"brier", m.brier},
          {"brier_base", m.brier_base},
          {"foreseen", m.foreseen},
          {"lead_time_median_s", m.lead_time_median_s},
          {"false_alarms_per_min", m.false_alarms_per_min},
          {"path", errors}};
}

}  // namespace

Json finite_json(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json json_of(const Quantiles& q) {
  return {{"p50", q.p50}, {"p95", q.p95}, {"p99", q.p99}, {"max", q.max}};
}

std::string json_of(const Metrics& m, std::string_view log_sha256) {
  Json json = {{"duration_s", m.duration_s}};
  json.update(tracking(m));
  json.update(safety(m));
  json.update(events(m));
  json["intention"] = foresight(m);
  json["plan_ms"] = json_of(m.plan_ms);
  if (!log_sha256.empty()) json["log_sha256"] = log_sha256;
  return json.dump(2) + "\n";
}

}  // namespace foretrack
