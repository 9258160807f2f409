// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/foxglove/protocol.hpp"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

namespace foretrack::station::foxglove {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxItems = 4096;  // in one message
constexpr std::uint8_t kMessageData = 1;

std::optional<std::uint32_t> id_of(const Json& value) {
  if (!value.is_number_unsigned()) return std::nullopt;
  const auto number = value.get<std::uint64_t>();
  if (number > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  return static_cast<std::uint32_t>(number);
}

std::optional<std::uint32_t> id_of(const Json& object, const char* key) {
  if (!object.is_object()) return std::nullopt;
  const auto it = object.find(key);
  return it == object.end() ? std::nullopt : id_of(*it);
}

const Json* list_of(const Json& message, const char* key) {
  const auto it = message.find(key);
  return it != message.end() && it->is_array() && it->size() <= kMaxItems ? &*it : nullptr;
}

ClientMessage parse_subscribe(const Json& message) {
  const auto* list = list_of(message, "subscriptions");
  if (!list) return Malformed{"subscribe: a list 'subscriptions' expected"};
  Subscribe result;
  for (const auto& item : *list) {
    const auto id = id_of(item, "id");
    const auto channel = id_of(item, "channelId");
    if (!id || !channel) return Malformed{"subscribe: numbers 'id' and 'channelId' expected"};
    result.subscriptions.emplace_back(*id, *channel);
  }
  return result;
}

ClientMessage parse_unsubscribe(const Json& message) {
  const auto* list = list_of(message, "subscriptionIds");
  if (!list) return Malformed{"unsubscribe: a list 'subscriptionIds' expected"};
  Unsubscribe result;
  for (const auto& item : *list) {
    const auto id = id_of(item);
    if (!id) return Malformed{"unsubscribe: numbers expected"};
    result.ids.push_back(*id);
  }
  return result;
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

// Names come from the bus, where anybody may write what is not UTF-8.
std::string dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string_view choose_subprotocol(std::string_view header) {
  while (!header.empty()) {
    const auto comma = header.find(',');
    const auto asked = trim(header.substr(0, comma));
    const auto it = std::find(kSubprotocols.begin(), kSubprotocols.end(), asked);
    if (it != kSubprotocols.end()) return *it;
    if (comma == std::string_view::npos) break;
    header.remove_prefix(comma + 1);
  }
  return {};
}

ClientMessage parse_text(std::string_view text) {
  const auto message = Json::parse(text, nullptr, false);
  if (!message.is_object()) return Malformed{"a JSON object expected"};
  const auto op = message.find("op");
  if (op == message.end() || !op->is_string()) return Malformed{"a string 'op' expected"};
  const auto& name = op->get_ref<const std::string&>();
  if (name == "subscribe") return parse_subscribe(message);
  if (name == "unsubscribe") return parse_unsubscribe(message);
  if (name == "subscribeConnectionGraph") return WantGraph{true};
  if (name == "unsubscribeConnectionGraph") return WantGraph{false};
  return NotOffered{name.substr(0, 64)};
}

ClientMessage parse_binary(std::span<const std::uint8_t> data) {
  if (data.empty()) return Malformed{"an empty binary message"};
  return NotOffered{"binary message " + std::to_string(data.front())};
}

std::string server_info(const std::string& name, const std::string& session_id,
                        const std::string& version) {
  return dump({{"op", "serverInfo"},
               {"name", name},
               {"capabilities", Json::array({"connectionGraph"})},
               {"metadata", {{"version", version}}},
               {"sessionId", session_id}});
}

std::string advertise(const std::vector<Channel>& channels) {
  Json list = Json::array();
  for (const auto& c : channels) {
    Json one = {{"id", c.id},
                {"topic", c.topic},
                {"encoding", c.encoding},
                {"schemaName", c.schema_name},
                {"schema", c.schema}};
    if (!c.schema_encoding.empty()) one["schemaEncoding"] = c.schema_encoding;
    list.push_back(std::move(one));
  }
  return dump({{"op", "advertise"}, {"channels", std::move(list)}});
}

std::string unadvertise(const std::vector<std::uint32_t>& channels) {
  return dump({{"op", "unadvertise"}, {"channelIds", channels}});
}

// A topic is listed on the side on which it changed, with all of that side.
std::string graph_update(const Graph& before, const Graph& now) {
  Json published = Json::array(), subscribed = Json::array(), removed = Json::array();
  const Ends none;
  for (const auto& [topic, ends] : now) {
    const auto it = before.find(topic);
    const auto& old = it == before.end() ? none : it->second;
    if (ends.publishers != old.publishers)
      published.push_back({{"name", topic}, {"publisherIds", ends.publishers}});
    if (ends.subscribers != old.subscribers)
      subscribed.push_back({{"name", topic}, {"subscriberIds", ends.subscribers}});
  }
  for (const auto& [topic, ends] : before)
    if (!now.contains(topic)) removed.push_back(topic);
  if (published.empty() && subscribed.empty() && removed.empty()) return {};
  return dump({{"op", "connectionGraphUpdate"},
               {"publishedTopics", std::move(published)},
               {"subscribedTopics", std::move(subscribed)},
               {"advertisedServices", Json::array()},
               {"removedTopics", std::move(removed)},
               {"removedServices", Json::array()}});
}

std::string status(Level level, const std::string& message) {
  return dump({{"op", "status"}, {"level", static_cast<int>(level)}, {"message", message}});
}

std::array<std::uint8_t, kMessageHeaderBytes> message_header(std::uint32_t subscription,
                                                             std::int64_t log_time_ns) {
  std::array<std::uint8_t, kMessageHeaderBytes> header{kMessageData};
  for (int i = 0; i < 4; ++i) header[1 + i] = static_cast<std::uint8_t>(subscription >> (8 * i));
  const auto time = static_cast<std::uint64_t>(log_time_ns);
  for (int i = 0; i < 8; ++i) header[5 + i] = static_cast<std::uint8_t>(time >> (8 * i));
  return header;
}

}  // namespace foretrack::station::foxglove
