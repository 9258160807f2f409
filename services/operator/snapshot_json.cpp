// SPDX-License-Identifier: Apache-2.0
#include "services/operator/snapshot_json.hpp"

#include <nlohmann/json.hpp>

#include "services/operator/words.hpp"

namespace foretrack {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const foretrack_msgs::msg::TargetState& t) {
  return {{"status", track_word(t.status())},
          {"position_m", t.position_m()},
          {"velocity_mps", t.velocity_mps()},
          {"last_measurement_age_s", t.last_measurement_age_s()}};
}

Json json_of(const foretrack_msgs::msg::TargetIntention& m) {
  Json json = Json::object();
  for (const auto& i : m.intentions()) json[i.name().c_str()] = i.probability();
  return json;
}

Json json_of(const foretrack_msgs::msg::PlannedTrajectory& p) {
  Json stages = Json::object();
  for (const auto& s : p.stage_times()) stages[s.stage().c_str()] = s.ms();
  return {{"status", plan_word(p.status())},
          {"reason", explain_plan(p.reason())},
          {"id", p.id()},
          {"stage_ms", stages}};
}

Json json_of(const foretrack_msgs::msg::SafetyState& s) {
  return {{"mode", mode_word(s.mode())}, {"reason", explain_gate(s.reason())},
          {"armed", s.armed()},          {"offboard", s.offboard()},
          {"heartbeat", s.heartbeat()},  {"deviation_m", s.deviation_m()},
          {"text", s.text().c_str()}};
}

Json json_of(const ServiceReport& s) {
  const auto& h = s.health;
  return {{"service", h.service().c_str()},
          {"state", service_word(h.state())},
          {"age_s", s.age_s},
          {"cpu_percent", h.cpu_percent()},
          {"rss_bytes", h.rss_bytes()},
          {"loop_mean_ms", h.loop_mean_ms()},
          {"loop_max_ms", h.loop_max_ms()},
          {"last_error", h.last_error().c_str()}};
}

}  // namespace

nlohmann::ordered_json to_json(const TopicFlow& f) {
  Json rejected = Json::object();
  for (const auto& [reason, count] : f.rejected) rejected[reason] = count;
  return {{"topic", f.topic},     {"wire", f.wire},
          {"rate_hz", f.rate_hz}, {"age_s", f.age_s},
          {"writers", f.writers}, {"readers", f.readers},
          {"samples", f.samples}, {"incompatible_qos", f.incompatible_qos},
          {"rejected", rejected}};
}

nlohmann::ordered_json to_json(const FlightSnapshot& p) {
  Json json = {{"vehicle", p.vehicle}, {"domain", p.domain}, {"now_s", p.now_s}};
  json["distance_m"] = distance_m(p);
  json["speed_mps"] = speed_mps(p);
  if (p.target) json["target"] = json_of(*p.target);
  if (p.intention) json["intention"] = json_of(*p.intention);
  if (p.prediction) json["prediction"]["status"] = prediction_word(p.prediction->status());
  if (p.plan) json["plan"] = json_of(*p.plan);
  if (p.safety) json["safety"] = json_of(*p.safety);
  json["services"] = Json::array();
  for (const auto& s : p.services) json["services"].push_back(json_of(s));
  json["topics"] = Json::array();
  for (const auto& f : p.flows) json["topics"].push_back(to_json(f));
  json["foreign"] = p.foreign;
  return json;
}

}  // namespace foretrack
