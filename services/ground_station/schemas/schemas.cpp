// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/schemas/schemas.hpp"

#include <algorithm>

#include "services/ground_station/schemas/schema_table.hpp"

namespace foretrack::station {

const Schema* find_schema(std::string_view wire_type) {
  const auto table = schema_table();
  const auto it = std::lower_bound(
      table.begin(), table.end(), wire_type,
      [](const SchemaRow& row, std::string_view wanted) { return row.wire_type < wanted; });
  return it != table.end() && it->wire_type == wire_type ? &it->schema : nullptr;
}

std::string readable_type(std::string_view wire_type) {
  if (const auto* schema = find_schema(wire_type)) return std::string(schema->name);
  constexpr std::string_view kInfix = "::dds_::";
  const auto at = wire_type.find(kInfix);
  if (at == std::string_view::npos || !wire_type.ends_with('_')) return std::string(wire_type);
  auto name = std::string(wire_type.substr(at + kInfix.size()));
  name.pop_back();
  return std::string(wire_type.substr(0, at)) + "::" + name;
}

}  // namespace foretrack::station
