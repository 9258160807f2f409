// SPDX-License-Identifier: Apache-2.0
// A value put into a YAML document from outside, as in --set target.speed_m_s=2.0.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

namespace foretrack {

/// Puts the value of KEY=VALUE where the file would have it; mappings on the way are made.
/// Throws std::invalid_argument if it is not of that form or the key leads through a value.
void apply_setting(const std::string& setting, const YAML::Node& document);

}  // namespace foretrack
