// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/status.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace foretrack::station {
namespace {

using Json = nlohmann::ordered_json;

constexpr char kSchema[] = R"({"type": "object", "properties": {
  "server": {"type": "object"},
  "vehicles": {"type": "array", "items": {"type": "object"}},
  "recording": {"type": ["object", "null"]},
  "recording_fault": {"type": ["string", "null"]},
  "warnings": {"type": "array", "items": {"type": "string"}},
  "topics": {"type": "array", "items": {"type": "object"}},
  "clients": {"type": "array", "items": {"type": "object"}}}})";

Json json_of(const TopicReport& t, bool limited) {
  return {{"topic", t.topic},
          {"channel", t.channel},
          {"type", t.type},
          {"vehicle", t.vehicle},
          {"writers", t.writers},
          {"readers", t.readers},
          {"rate_hz", t.rate_hz},
          {"bytes_s", t.bytes_s},
          {"age_s", t.age_s < 0.0 ? Json() : Json(t.age_s)},
          {"limited", limited},
          {"resting", t.resting},
          {"qos_mismatch", t.qos_mismatch},
          {"foreign_type", t.foreign_type.empty() ? Json() : Json(t.foreign_type)}};
}

Json lease_of(const MissionStatus* m) {
  if (!m || m->lease_operator.empty()) return nullptr;
  return {{"operator", m->lease_operator}, {"expires_s", m->lease_expires_s}};
}

Json command_of(const MissionStatus* m) {
  if (!m || m->command_id == 0) return nullptr;
  return {{"id", m->command_id},
          {"command", m->command},
          {"operator", m->operator_name},
          {"result", m->result},
          {"reason", m->reason}};
}

Json unconfirmed_of(const MissionStatus* m) {
  if (!m || !m->unconfirmed) return nullptr;
  return {{"command", m->unconfirmed->command},
          {"operator", m->unconfirmed->operator_name},
          {"still_sent", m->unconfirmed->still_sent}};
}

Json json_of(const VehicleReport& v, const MissionStatus* mission) {
  return {
      {"name", v.name},
      {"seen_s_ago", v.seen_s_ago < 0.0 ? Json() : Json(v.seen_s_ago)},
      {"clock_ahead_s", v.clock_ahead_s ? Json(*v.clock_ahead_s) : Json()},
      {"lease", lease_of(mission)},
      {"last_command", command_of(mission)},
      {"unconfirmed", unconfirmed_of(mission)},
      {"orders_refused", mission && !mission->refused.empty() ? Json(mission->refused) : Json()}};
}

Json json_of(const ClientReport& c) {
  return {{"id", c.id},           {"address", c.address},       {"subscriptions", c.subscriptions},
          {"bytes_s", c.bytes_s}, {"sent_bytes", c.sent_bytes}, {"waiting_bytes", c.waiting_bytes},
          {"dropped", c.dropped}};
}

Json json_of(const std::optional<RecordingStatus>& r) {
  if (!r) return nullptr;
  return {{"active", true},
          {"file", r->file},
          {"bytes", r->bytes},
          {"seconds", r->seconds},
          {"lost", r->lost}};
}

}  // namespace

std::string to_json_text(const Status& s) {
  Json json;
  json["server"] = {{"version", s.server.version},
                    {"uptime_s", s.server.uptime_s},
                    {"clients", std::count_if(s.clients.begin(), s.clients.end(),
                                              [](const auto& client) { return client.watches; })},
                    {"control_enabled", s.server.control_enabled},
                    {"needs_token", s.server.needs_token}};
  json["vehicles"] = Json::array();
  for (const auto& v : s.vehicles) {
    const auto mission = s.missions.find(v.name);
    json["vehicles"].push_back(
        json_of(v, mission == s.missions.end() ? nullptr : &mission->second));
  }
  json["recording"] = json_of(s.recording);
  json["recording_fault"] = s.recording_fault.empty() ? Json() : Json(s.recording_fault);
  json["warnings"] = s.warnings;
  json["topics"] = Json::array();
  for (const auto& t : s.topics)
    json["topics"].push_back(json_of(t, s.limited.contains(t.channel)));
  json["clients"] = Json::array();
  for (const auto& c : s.clients) json["clients"].push_back(json_of(c));
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Channel status_channel() {
  Channel channel;
  channel.id = 0;
  channel.topic = "/station/status";
  channel.encoding = "json";
  channel.schema_name = "foretrack.StationStatus";
  channel.schema_encoding = "jsonschema";
  channel.schema = kSchema;
  channel.latched = true;
  return channel;
}

}  // namespace foretrack::station
