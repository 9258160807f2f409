// SPDX-License-Identifier: Apache-2.0
// The table that idl/type_hashes.py writes from idl/ at build.
#pragma once

#include <span>
#include <string_view>

namespace foretrack {

struct TypeHashRow {
  std::string_view wire_type, hash;
};

/// Sorted by wire type.
std::span<const TypeHashRow> type_hash_table();

}  // namespace foretrack
