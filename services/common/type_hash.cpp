// SPDX-License-Identifier: Apache-2.0
#include "services/common/type_hash.hpp"

#include <algorithm>

#include "core/version.hpp"
#include "services/common/type_hash_table.hpp"

namespace foretrack {
namespace {

constexpr std::string_view kOurs = "foretrack_msgs::";

// Of "key=value;key=value;".
std::string value_of(std::string_view text, std::string_view key) {
  while (!text.empty()) {
    const auto pair = text.substr(0, text.find(';'));
    text.remove_prefix(std::min(text.size(), pair.size() + 1));
    const auto equals = pair.find('=');
    if (equals != std::string_view::npos && pair.substr(0, equals) == key)
      return std::string(pair.substr(equals + 1));
  }
  return {};
}

}  // namespace

std::string_view type_hash_of(std::string_view wire_type) {
  const auto table = type_hash_table();
  const auto it = std::lower_bound(
      table.begin(), table.end(), wire_type,
      [](const TypeHashRow& row, std::string_view wanted) { return row.wire_type < wanted; });
  return it != table.end() && it->wire_type == wire_type ? it->hash : std::string_view();
}

std::vector<std::uint8_t> told_of_type(std::string_view wire_type) {
  const auto hash = type_hash_of(wire_type);
  if (hash.empty()) return {};
  std::string text = "typehash=" + std::string(hash) + ';';
  if (wire_type.starts_with(kOurs)) text += std::string("foretrack=") + kVersion + ';';
  return {text.begin(), text.end()};
}

ToldOfType read_told(const std::vector<std::uint8_t>& user_data) {
  const std::string text(user_data.begin(), user_data.end());
  return {value_of(text, "typehash"), value_of(text, "foretrack")};
}

std::string other_version(std::string_view wire_type, const ToldOfType& told) {
  const auto ours = type_hash_of(wire_type);
  if (ours.empty() || told.hash.empty() || told.hash == ours) return {};
  std::string text = std::string(wire_type) + " is of another version than ours";
  if (!told.version.empty()) text += " (foretrack " + told.version + ", here " + kVersion + ')';
  return text;
}

}  // namespace foretrack
