// SPDX-License-Identifier: Apache-2.0
#include "services/files/config/apply_setting.hpp"

#include <fmt/format.h>

#include <sstream>
#include <stdexcept>
#include <vector>

namespace foretrack {
namespace {

[[noreturn]] void refuse_setting(const std::string& setting) {
  throw std::invalid_argument(
      fmt::format("setting '{}': expected KEY=VALUE with a key of the scenario file, as in "
                  "target.speed_m_s=2.0",
                  setting));
}

}  // namespace

void apply_setting(const std::string& setting, const YAML::Node& document) {
  const auto equals = setting.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == setting.size())
    refuse_setting(setting);
  YAML::Node value;
  try {
    value = YAML::Load(setting.substr(equals + 1));
  } catch (const YAML::ParserException&) {
    refuse_setting(setting);
  }
  std::istringstream path(setting.substr(0, equals));
  std::vector<std::string> keys;
  for (std::string key; std::getline(path, key, '.');) keys.push_back(key);
  YAML::Node node = document;
  for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
    if (node.IsDefined() && !node.IsNull() && !node.IsMap()) refuse_setting(setting);
    node.reset(node[keys[i]]);
  }
  if (keys.empty() || (node.IsDefined() && !node.IsNull() && !node.IsMap()))
    refuse_setting(setting);
  node[keys.back()] = value;
}

}  // namespace foretrack
