// SPDX-License-Identifier: Apache-2.0
#include "services/common/names.hpp"

#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "services/common/px4_releases.hpp"
#include "services/common/topics.hpp"

namespace foretrack {
namespace {

bool is_name(std::string_view text) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !text.empty() && text.front() >= 'a' && text.front() <= 'z' &&
         std::all_of(text.begin(), text.end(), allowed);
}

bool is_path(std::string_view text) {
  while (true) {
    const auto slash = text.find('/');
    if (!is_name(text.substr(0, slash))) return false;
    if (slash == std::string_view::npos) return true;
    text.remove_prefix(slash + 1);
  }
}

// Of others: ROS 2 allows capitals, too.
bool is_foreign_topic(std::string_view text) {
  if (text.starts_with('/')) text.remove_prefix(1);
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '/';
  };
  return !text.empty() && text.front() != '/' && text.back() != '/' &&
         text.find("//") == std::string_view::npos &&
         std::all_of(text.begin(), text.end(), allowed);
}

std::vector<std::string_view> known_names() {
  return []<class... Topic>(std::tuple<Topic...>*) {
    return std::vector<std::string_view>{Topic::info.name...};
  }(static_cast<topics::All*>(nullptr));
}

// That shares most of its last words.
std::string_view nearest_name(std::string_view name) {
  const auto shared = [name](std::string_view known) {
    std::size_t front = 0, back = 0;
    while (front < std::min(name.size(), known.size()) && name[front] == known[front]) ++front;
    while (back < std::min(name.size(), known.size()) &&
           name[name.size() - 1 - back] == known[known.size() - 1 - back])
      ++back;
    return front + back;
  };
  const auto names = known_names();
  return *std::max_element(names.begin(), names.end(),
                           [&](auto a, auto b) { return shared(a) < shared(b); });
}

void require(bool ok, const std::string& what, const std::string& value) {
  if (!ok)
    throw std::invalid_argument(what + " '" + value +
                                "': lower-case letters, digits and _ expected, a letter first");
}

}  // namespace

void validate_or_throw(const Names& names) {
  require(is_name(names.vehicle), "vehicle name", names.vehicle);
  require(is_path(names.clock_topic), "clock topic", names.clock_topic);
  require(names.px4_namespace.empty() || is_path(names.px4_namespace), "PX4 namespace",
          names.px4_namespace);
  require(is_foreign_topic(names.body_frame), "body frame", names.body_frame);
  if (!names.px4_release.empty()) check_px4_release(names.px4_release);
}

void add_remap(Names& names, std::string_view text) {
  const auto at = text.find(":=");
  const std::string name(text.substr(0, at));
  if (at == std::string_view::npos || name.empty())
    throw std::invalid_argument("--remap '" + std::string(text) + "': NAME:=TOPIC expected");
  const auto known = known_names();
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw std::invalid_argument("--remap " + name + ": no topic has this name; the nearest is '" +
                                std::string(nearest_name(name)) + "'");
  auto topic = text.substr(at + 2);
  if (!is_foreign_topic(topic))
    throw std::invalid_argument("--remap " + name + ":='" + std::string(topic) +
                                "': a topic expected, as ROS 2 has them: camera/image_raw");
  if (topic.starts_with('/')) topic.remove_prefix(1);
  names.remaps[name] = topic;
}

std::string unversioned_topic_name(const TopicInfo& info, const Names& names) {
  if (const auto it = names.remaps.find(std::string(info.name)); it != names.remaps.end())
    return "rt/" + it->second;
  std::string result = "rt/";
  if (info.scope == Scope::kClock) return result + names.clock_topic;
  if (info.scope == Scope::kVehicle) result += names.vehicle + '/';
  if (info.scope == Scope::kPx4 && !names.px4_namespace.empty())
    result += names.px4_namespace + '/';
  return result.append(info.name);
}

std::string topic_name(const TopicInfo& info, const Names& names) {
  std::string result = unversioned_topic_name(info, names);
  if (info.scope != Scope::kPx4 || names.remaps.contains(std::string(info.name))) return result;
  const auto release = names.px4_release.empty() ? kPx4ReleaseOfIdl : names.px4_release;
  const int version = px4_version(info.name.substr(info.name.rfind('/') + 1), release);
  if (version > 0) result += "_v" + std::to_string(version);
  return result;
}

}  // namespace foretrack
