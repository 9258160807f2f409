// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/bus/survey.hpp"

#include <algorithm>

#include "services/ground_station/bus/contract.hpp"

namespace foretrack::station {
namespace {

using Endpoints = std::vector<const ForeignEndpoint*>;

std::string type_of(const std::string& topic, const Endpoints& endpoints) {
  if (const auto* known = contract_of(topic)) return std::string(known->type);
  const auto writer = std::find_if(endpoints.begin(), endpoints.end(),
                                   [](const ForeignEndpoint* e) { return e->writes; });
  return (writer == endpoints.end() ? endpoints.front() : *writer)->type;
}

bool mismatch(const ForeignEndpoint& writer, const ForeignEndpoint& reader) {
  return writer.type == reader.type &&
         ((reader.reliable && !writer.reliable) || (reader.latched && !writer.latched));
}

bool any_mismatch(const Endpoints& endpoints) {
  for (const auto* writer : endpoints)
    for (const auto* reader : endpoints)
      if (writer->writes && !reader->writes && mismatch(*writer, *reader)) return true;
  return false;
}

// As much as all writers offer: what one of them does not offer would silence it.
const char* profile_of(const std::string& type, const Endpoints& endpoints) {
  bool reliable = true;
  bool latched = std::any_of(endpoints.begin(), endpoints.end(),
                             [](const ForeignEndpoint* e) { return e->writes; });
  for (const auto* e : endpoints) {
    if (!e->writes || e->type != type) continue;
    reliable = reliable && e->reliable;
    latched = latched && e->latched;
  }
  if (!reliable) return "sensor";
  return latched ? "latched" : "state";
}

SurveyedTopic survey_one(const std::string& name, const Endpoints& endpoints) {
  SurveyedTopic topic;
  topic.type = type_of(name, endpoints);
  for (const auto* e : endpoints) {
    if (e->type != topic.type || (e->keyed && contract_of(name))) {
      topic.foreign_type = e->type + (e->keyed ? " (keyed)" : "");
    } else {
      topic.keyed = e->keyed;
      topic.writers += e->writes;
    }
    topic.readers += !e->writes;
    (e->writes ? topic.writing : topic.reading).insert(e->peer);
  }
  topic.qos_mismatch = any_mismatch(endpoints);
  topic.profile = profile_of(topic.type, endpoints);
  return topic;
}

}  // namespace

std::map<std::string, SurveyedTopic> survey(const std::vector<ForeignEndpoint>& endpoints) {
  std::map<std::string, Endpoints> by_topic;
  for (const auto& e : endpoints)
    if (e.topic.starts_with("rt/")) by_topic[e.topic].push_back(&e);
  std::map<std::string, SurveyedTopic> result;
  for (const auto& [name, found] : by_topic) result[name] = survey_one(name, found);
  return result;
}

}  // namespace foretrack::station
