// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/schemas/schemas.hpp"

#include <algorithm>

#include "services/common/type_hash.hpp"
#include "services/ground_station/schemas/schema_table.hpp"

namespace foretrack::station {

namespace {

const SchemaRow* find_row(std::string_view wire_type) {
  const auto table = schema_table();
  const auto it = std::lower_bound(
      table.begin(), table.end(), wire_type,
      [](const SchemaRow& row, std::string_view wanted) { return row.wire_type < wanted; });
  return it != table.end() && it->wire_type == wire_type ? &*it : nullptr;
}

// IDL has the message last, and its end behind its fields; ros2msg has it first, and the types
// inside it behind a ruler.
bool is_beginning_of(std::string_view recorded, std::string_view ours) {
  constexpr std::string_view kRuler = "\n====";
  const auto of_recorded = recorded.find(kRuler), of_ours = ours.find(kRuler);
  if (recorded.starts_with("module"))
    return ours.starts_with(recorded.substr(0, recorded.find_last_not_of("};\n ") + 2));
  const auto rest = [](std::string_view text, std::size_t at) {
    return at == std::string_view::npos ? std::string_view() : text.substr(at);
  };
  const std::string fields = std::string(recorded.substr(0, of_recorded)) + '\n';
  return rest(recorded, of_recorded) == rest(ours, of_ours) && ours.starts_with(fields);
}

}  // namespace

const Schema* find_schema(std::string_view wire_type) {
  const auto* row = find_row(wire_type);
  return row ? &row->schema : nullptr;
}

const Schema* find_ros_schema(std::string_view wire_type) {
  const auto* row = find_row(wire_type);
  if (!row) return nullptr;
  return row->ros.text.empty() ? &row->schema : &row->ros;
}

RecordedType compare_recorded(std::string_view wire_type, std::string_view hash,
                              std::string_view schema) {
  const auto* row = find_row(wire_type);
  if (!row) return RecordedType::kUnknown;
  if (!hash.empty() && hash == type_hash_of(wire_type)) return RecordedType::kSame;
  const auto ours = {row->schema.text, row->ros.text};
  if (hash.empty() && std::find(ours.begin(), ours.end(), schema) != ours.end())
    return RecordedType::kSame;
  const bool older = std::any_of(ours.begin(), ours.end(), [&](std::string_view text) {
    return !schema.empty() && is_beginning_of(schema, text);
  });
  return older ? RecordedType::kOlder : RecordedType::kOther;
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
