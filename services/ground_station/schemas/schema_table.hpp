// SPDX-License-Identifier: Apache-2.0
// The table that make_schemas.py writes from idl/ at build.
#pragma once

#include <span>

#include "services/ground_station/schemas/schemas.hpp"

namespace foretrack::station {

struct SchemaRow {
  std::string_view wire_type;
  Schema schema;
  Schema ros;  // of our own types, as ROS 2 knows them; else empty
};

/// Sorted by wire type.
std::span<const SchemaRow> schema_table();

}  // namespace foretrack::station
