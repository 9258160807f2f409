// SPDX-License-Identifier: Apache-2.0
#include "services/common/names.hpp"

#include <algorithm>
#include <stdexcept>

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
}

std::string topic_name(const TopicInfo& info, const Names& names) {
  std::string result = "rt/";
  if (info.scope == Scope::kClock) return result + names.clock_topic;
  if (info.scope == Scope::kVehicle) result += names.vehicle + '/';
  if (info.scope == Scope::kPx4 && !names.px4_namespace.empty())
    result += names.px4_namespace + '/';
  result += info.name;
  if (info.versioned && names.px4_vehicle_status_version > 0)
    result += "_v" + std::to_string(names.px4_vehicle_status_version);
  return result;
}

}  // namespace foretrack
